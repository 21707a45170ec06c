#include "engine/display/late_warp_gpu.h"

namespace stereonav {
namespace {

void nearestTexels() {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void bind(GLenum unit, const GlTexture& texture) {
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D, texture.name());
}

// Binds a framebuffer, and the one bound before again at the end: the window draws into its own.
class DrawInto {
public:
    DrawInto(const GlFramebuffer& target, int width, int height) {
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &mBefore);
        glGetIntegerv(GL_VIEWPORT, mViewport.data());
        glBindFramebuffer(GL_FRAMEBUFFER, target.name());
        glViewport(0, 0, width, height);
    }
    ~DrawInto() {
        glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(mBefore));
        glViewport(mViewport[0], mViewport[1], mViewport[2], mViewport[3]);
    }
    DrawInto(const DrawInto&) = delete;
    DrawInto& operator=(const DrawInto&) = delete;

private:
    GLint mBefore = 0;
    std::array<GLint, 4> mViewport{};
};

}  // namespace

LateWarpGpu::LateWarpGpu() : mProgram("stereo_present.vert", "late_warp.frag") {
    mProgram.use();
    glUniform1i(mProgram.location("uColor"), 0);
    glUniform1i(mProgram.location("uInverse"), 1);
    glUniform1i(mProgram.location("uPlans"), 2);
    glUniform2i(mProgram.location("uTile"), kLateTileWidth, kLateTileHeight);
    sizeImage(mEyes[0], 1, 1);
}

void LateWarpGpu::sizeImage(Eye& eye, int width, int height) {
    if (eye.shownWidth == width && eye.shownHeight == height) return;
    eye.shownWidth = width;
    eye.shownHeight = height;
    bind(GL_TEXTURE0, eye.image);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB10_A2, width, height, 0, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV,
                 nullptr);
    nearestTexels();
    const DrawInto target(eye.framebuffer, width, height);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, eye.image.name(), 0);
    mWorks = mWorks && glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void LateWarpGpu::take(std::size_t which, const LateEye& late, const Plane<PackedColor>& color) {
    Eye& eye = mEyes[which];
    const Plane<float>& inverse = late.inverse();
    const bool resized = eye.width != inverse.width() || eye.height != inverse.height();
    eye.width = inverse.width();
    eye.height = inverse.height();
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    const auto upload = [&](const GlTexture& texture, GLint kind, GLenum format, GLenum type, int stride,
                            const void* texels) {
        bind(GL_TEXTURE0, texture);
        if (resized) {
            glTexImage2D(GL_TEXTURE_2D, 0, kind, eye.width, eye.height, 0, format, type, nullptr);
            nearestTexels();
        }
        glPixelStorei(GL_UNPACK_ROW_LENGTH, stride);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, eye.width, eye.height, format, type, texels);
    };
    upload(eye.color, GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, color.stride(), color.row(0));
    upload(eye.inverse, GL_R32F, GL_RED, GL_FLOAT, inverse.stride(), inverse.row(0));
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

GLuint LateWarpGpu::warp(std::size_t which, const LateEye& late, const EyeView& to) {
    Eye& eye = mEyes[which];
    sizeImage(eye, to.width, to.height);
    const LateMove move = late.planAll(to, mPlans);
    const int across = (to.width + kLateTileWidth - 1) / kLateTileWidth,
              down = (to.height + kLateTileHeight - 1) / kLateTileHeight;
    mTexels.clear();
    for (const LatePlan& plan : mPlans)
        mTexels.insert(mTexels.end(), {plan.farthest, plan.nearest, static_cast<float>(plan.steps)});
    bind(GL_TEXTURE2, eye.plans);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (eye.across != across || eye.down != down) {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, across, down, 0, GL_RGB, GL_FLOAT, mTexels.data());
        nearestTexels();
        eye.across = across;
        eye.down = down;
    } else {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, across, down, GL_RGB, GL_FLOAT, mTexels.data());
    }
    bind(GL_TEXTURE1, eye.inverse);
    bind(GL_TEXTURE0, eye.color);
    mProgram.use();
    glUniform2i(mProgram.location("uSize"), eye.width, eye.height);
    glUniform3fv(mProgram.location("uRows"), 3, &move.rows[0][0]);
    glUniform3fv(mProgram.location("uShift"), 1, move.shift);
    const DrawInto target(eye.framebuffer, to.width, to.height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(mVertices.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    return eye.image.name();
}

void LateWarpGpu::read(std::size_t which, Plane<PackedColor>& image, Plane<std::uint8_t>* uncovered) const {
    const Eye& eye = mEyes[which];
    image.resize(eye.shownWidth, eye.shownHeight);
    if (uncovered) uncovered->resize(eye.shownWidth, eye.shownHeight);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, eye.image.name());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, image.stride());
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, image.row(0));
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    constexpr PackedColor kColor = 0x3fffffffu;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            if (uncovered) uncovered->at(x, y) = image.at(x, y) > kColor ? 255 : 0;
            image.at(x, y) &= kColor;
        }
}

}  // namespace stereonav
