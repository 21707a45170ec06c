// Layout, storage and reading back.
#include "engine/display/medium_gpu_targets.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"

namespace stereonav {
namespace {

void allocate(const GlTexture& texture, GLenum format, const glm::ivec2& size, GLint filter) {
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexStorage2D(GL_TEXTURE_2D, 1, format, size.x, size.y);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void checkSize(const glm::ivec2& size) {
    GLint texture = 0, viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    const int most = std::min({texture, viewport[0], viewport[1]});
    if (size.x > most || size.y > most)
        throw Error("", "volume light's target",
                    fmt::format("expected at most {} pixels a side, got {}x{}", most, size.x, size.y),
                    "make the picture or the light's buffer smaller, or use separate targets");
}

}  // namespace

MediumTargets::MediumTargets(const TargetSizes& sizes) : mSizes(sizes) {
    if (sizes.single)
        layOutOne();
    else
        layOutEach();
    for (const Surface& surface : mSurfaces) checkSize(surface.size);
    for (Surface& surface : mSurfaces) makeSurface(surface);
}

// Eyes in a row, the light's two regions in a row below.
void MediumTargets::layOutOne() {
    glm::ivec2 size{0};
    for (const glm::ivec2& eye : mSizes.eyes) {
        mEyes.push_back({0, {size.x, 0}, eye});
        size = {size.x + eye.x, std::max(size.y, eye.y)};
    }
    if (mSizes.light.x > 0) {
        const glm::ivec2 outer = mSizes.light + 2 * kRing;
        for (int turn = 0; turn < 2; ++turn)
            mLights[turn] = {0, {turn * outer.x + kRing, size.y + kRing}, mSizes.light};
        size = {std::max(size.x, 2 * outer.x), size.y + outer.y};
    }
    mSurfaces.resize(1);
    mSurfaces[0].size = size;
    mSurfaces[0].forEyes = true;
}

void MediumTargets::layOutEach() {
    const std::size_t eyes = mSizes.eyes.size();
    mSurfaces.resize(eyes + (mSizes.light.x > 0 ? 2 : 0));
    for (std::size_t eye = 0; eye < eyes; ++eye) {
        mEyes.push_back({eye, {0, 0}, mSizes.eyes[eye]});
        mSurfaces[eye].size = mSizes.eyes[eye];
        mSurfaces[eye].forEyes = true;
    }
    for (std::size_t turn = 0; eyes + turn < mSurfaces.size(); ++turn) {
        mLights[turn] = {eyes + turn, glm::ivec2(kRing), mSizes.light};
        mSurfaces[eyes + turn].size = mSizes.light + 2 * kRing;
    }
}

void MediumTargets::makeSurface(Surface& surface) {
    glBindFramebuffer(GL_FRAMEBUFFER, surface.framebuffer.name());
    const auto attach = [&](const GlTexture& texture, GLenum format, GLenum place, GLint filter) {
        allocate(texture, format, surface.size, filter);
        glFramebufferTexture2D(GL_FRAMEBUFFER, place, GL_TEXTURE_2D, texture.name(), 0);
    };
    attach(surface.color, GL_RGBA32F, GL_COLOR_ATTACHMENT0, GL_LINEAR);
    if (surface.forEyes) {
        attach(surface.viewDepth, GL_R32F, GL_COLOR_ATTACHMENT1, GL_NEAREST);
        attach(surface.ended, GL_DEPTH_COMPONENT16, GL_DEPTH_ATTACHMENT, GL_NEAREST);
    }
    const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(surface.forEyes ? 2 : 1, buffers);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR)
        throw Error("", "volume light's target",
                    fmt::format("the graphics driver does not make one of {}x{} pixels", surface.size.x,
                                surface.size.y),
                    "make the picture smaller or use the CPU");
}

void MediumTargets::clear() {
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    const float nothing[] = {0, 0, 0, 1}, one[] = {1, 1, 1, 1}, miss[] = {kMissDepth, 0, 0, 0}, far = 1;
    for (const Surface& surface : mSurfaces) {
        glBindFramebuffer(GL_FRAMEBUFFER, surface.framebuffer.name());
        glClearBufferfv(GL_COLOR, 0, surface.forEyes ? nothing : one);
        if (!surface.forEyes) continue;
        glClearBufferfv(GL_COLOR, 1, miss);
        glClearBufferfv(GL_DEPTH, 0, &far);
    }
    if (mSizes.single && mSizes.light.x > 0) {
        const glm::ivec2 at = mLights[0].at - kRing, size = mSizes.light + 2 * kRing;
        glEnable(GL_SCISSOR_TEST);
        glScissor(at.x, at.y, 2 * size.x, size.y);
        glClearBufferfv(GL_COLOR, 0, one);
        glDisable(GL_SCISSOR_TEST);
    }
}

void MediumTargets::startLight(const std::vector<float>& scattered) {
    std::vector<glm::vec4> texels;
    texels.reserve(scattered.size());
    for (const float s : scattered) texels.emplace_back(s, s, s, 1.0f);
    const glm::ivec2 size = mSizes.light + 2 * kRing;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    for (const Region& light : mLights)
        glTextureSubImage2D(surfaceOf(light).color.name(), 0, light.at.x - kRing, light.at.y - kRing, size.x,
                            size.y, GL_RGBA, GL_FLOAT, texels.data());
}

void MediumTargets::drawTo(const Region& region) {
    // One target stays bound: telling the driver again would cost a switch.
    if (mSurfaces.size() > 1) glBindFramebuffer(GL_FRAMEBUFFER, surfaceOf(region).framebuffer.name());
    glViewport(region.at.x, region.at.y, region.size.x, region.size.y);
}

void MediumTargets::read(int eye, MediumPicture& picture) const {
    const Region& region = mEyes[static_cast<std::size_t>(eye)];
    picture.light.resize(region.size.x, region.size.y);
    picture.viewDepth.resize(region.size.x, region.size.y);
    glBindFramebuffer(GL_FRAMEBUFFER, surfaceOf(region).framebuffer.name());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    const auto get = [&](GLenum place, GLenum format, int stride, void* to) {
        glReadBuffer(place);
        glPixelStorei(GL_PACK_ROW_LENGTH, stride);
        glReadPixels(region.at.x, region.at.y, region.size.x, region.size.y, format, GL_FLOAT, to);
    };
    get(GL_COLOR_ATTACHMENT0, GL_RGBA, picture.light.stride(), picture.light.row(0));
    get(GL_COLOR_ATTACHMENT1, GL_RED, picture.viewDepth.stride(), picture.viewDepth.row(0));
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
}

}  // namespace stereonav
