// Textures, uniforms and one triangle.
#include "engine/display/stereo_presenter.h"

#include <fmt/format.h>

#include <array>
#include <glm/common.hpp>
#include <string>

#include "engine/base/error.h"

namespace stereonav {
namespace {

// Columns of the matrix that act on one eye, in OpenGL's column-major order.
std::array<float, 9> eyePart(const AnaglyphMatrix& m, std::size_t firstColumn) {
    std::array<float, 9> part{};
    for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t row = 0; row < 3; ++row) part[column * 3 + row] = m[row][firstColumn + column];
    return part;
}

}  // namespace

StereoPresenter::Pass StereoPresenter::passOf(const OutputModeInfo& info) {
    switch (info.layout) {
        case OutputLayout::SideBySide:
            return info.half ? Pass::HalfWidth : Pass::OneEye;
        case OutputLayout::TopBottom:
            return info.half ? Pass::HalfHeight : Pass::OneEye;
        case OutputLayout::Rows:
            return Pass::Rows;
        case OutputLayout::Columns:
            return Pass::Columns;
        case OutputLayout::Checkerboard:
            return Pass::Checkerboard;
        case OutputLayout::Anaglyph:
            return Pass::Anaglyph;
        case OutputLayout::OneEye:
        case OutputLayout::FramePacked:
        case OutputLayout::FrameSequential:  // eye_passes.h says which eye is drawn when
        case OutputLayout::QuadBuffer:
            break;
    }
    return Pass::OneEye;
}

const ShaderProgram& StereoPresenter::programFor(Pass pass, bool layered) const {
    if (const auto found = mPrograms.find({pass, layered}); found != mPrograms.end()) return found->second;
    const std::string defines =
        fmt::format("#define LAYOUT {}\n{}", static_cast<int>(pass), layered ? "#define OVER\n" : "");
    const ShaderProgram& program =
        mPrograms.try_emplace({pass, layered}, "stereo_present.vert", "stereo_present.frag", defines)
            .first->second;
    program.use();
    glUniform1i(program.location("uFirst"), 0);
    glUniform1i(program.location("uSecond"), 1);
    if (!layered) return program;
    glUniform1i(program.location("uFirstLayer"), 2);
    glUniform1i(program.location("uSecondLayer"), 3);
    return program;
}

void StereoPresenter::checkSizes(const Plane<PackedColor>& left, const Plane<PackedColor>* right) const {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (left.empty() || left.width() > largest || left.height() > largest)
        throw Error(
            "", "picture size",
            fmt::format("expected 1 to {} pixels a side, got {}x{}", largest, left.width(), left.height()),
            "make the window smaller");
    if (right && (right->width() != left.width() || right->height() != left.height()))
        throw Error("", "stereo picture",
                    fmt::format("expected two eyes of one size, got {}x{} and {}x{}", left.width(),
                                left.height(), right->width(), right->height()),
                    "render both eyes at the same size");
}

void StereoPresenter::show(SharedEye left, SharedEye right) {
    if (right && right->empty()) right = nullptr;
    checkSizes(*left, right.get());
    mOneEye = !right;
    mWidth = left->width();
    mHeight = left->height();
    mEyes[0].picture = std::move(left);
    mEyes[1].picture = std::move(right);
    for (Eye& eye : mEyes) {
        eye.uploaded = eye.plain = false;
        eye.given = 0;
    }
}

void StereoPresenter::showTextures(GLuint left, GLuint right, int width, int height) {
    mOneEye = right == 0;
    mWidth = width;
    mHeight = height;
    mEyes[0].given = left;
    mEyes[1].given = right;
    for (Eye& eye : mEyes) eye.picture = nullptr;
}

void StereoPresenter::upload(const Plane<PackedColor>& left, const Plane<PackedColor>& right) {
    show(std::make_shared<Plane<PackedColor>>(left), std::make_shared<Plane<PackedColor>>(right));
}

void StereoPresenter::uploadEye(std::size_t which) const {
    Eye& eye = mEyes[which];
    if (eye.given != 0 || std::exchange(eye.uploaded, true)) return;
    glBindTexture(GL_TEXTURE_2D, eye.texture.name());
    if (eye.width != mWidth || eye.height != mHeight) {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB10_A2, mWidth, mHeight, 0, GL_RGBA,
                     GL_UNSIGNED_INT_2_10_10_10_REV, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        eye.width = mWidth;
        eye.height = mHeight;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, eye.picture->stride());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, mWidth, mHeight, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV,
                    eye.picture->row(0));
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

bool StereoPresenter::copyEye(std::size_t which, const Viewport& viewport) const {
    Eye& eye = mEyes[which];
    if (eye.given != 0) return false;  // drawn by the shader
    glActiveTexture(GL_TEXTURE0);
    if (!std::exchange(eye.plain, true)) mPlain.upload(which, *eye.picture);
    if (!mPlain.copy(which, viewport.x, viewport.y)) return false;
    if (!mLayers) return true;
    if (!mLayerProgram)
        mLayerProgram = std::make_unique<ShaderProgram>("stereo_present.vert", "stereo_layer.frag");
    const EyeLayer& layer = (*mLayers)[which];
    mLayerProgram->use();
    glUniform1i(mLayerProgram->location("uLayer"), 0);
    glUniform2i(mLayerProgram->location("uCorner"), viewport.x, viewport.y);
    glBindTexture(GL_TEXTURE_2D, layer.texture);
    glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_SCISSOR_TEST);
    glBindVertexArray(mVertices.name());
    const glm::ivec2 whole(viewport.width, viewport.height);
    for (const EyeLayer::Box& box : layer.boxes) {
        const glm::ivec2 first = glm::clamp(box.first, glm::ivec2(0), whole),
                         last = glm::clamp(box.last, first, whole);
        if (first.x == last.x || first.y == last.y) continue;
        glScissor(viewport.x + first.x, viewport.y + whole.y - last.y, last.x - first.x, last.y - first.y);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    return true;
}

void StereoPresenter::draw(const ComposeSetting& setting, const Viewport& viewport, int turnX, int turnY,
                           const PartInset& inset) const {
    if (!hasPicture()) return;
    const OutputModeInfo& info = infoOf(setting.mode);
    const bool swapped = setting.swapEyes != info.rightFirst;
    const int right = mOneEye ? 0 : 1;
    const int first = swapped ? right : 0, second = swapped ? 0 : right;
    const Pass pass = passOf(info);
    const auto [width, height] = composedSize(setting.mode, mWidth, mHeight);
    const EyeArea picture = eyeAreas(setting.mode, width, height)[0];
    const auto areas = eyeAreas(setting.mode, viewport.width, viewport.height);
    const auto drawPart = [&](int eye, int other, const EyeArea& area) {
        const int bottom = viewport.y + viewport.height - area.y - area.height;
        const Viewport inside{viewport.x + area.x + inset.left, bottom + inset.bottom,
                              area.width - inset.left - inset.right, area.height - inset.top - inset.bottom};
        drawPass(pass, eye, other, inside, picture.width, picture.height, setting, turnX + inset.left,
                 turnY + inset.top);
    };
    if (areas[0] == areas[1]) return drawPart(first, second, areas[0]);
    drawPart(first, first, areas[0]);
    drawPart(second, second, areas[1]);
}

void StereoPresenter::drawPass(Pass pass, int first, int second, const Viewport& viewport, int pictureWidth,
                               int pictureHeight, const ComposeSetting& setting, int turnX, int turnY) const {
    if (viewport.width < 1 || viewport.height < 1) return;
    if (pass == Pass::OneEye && viewport.width == mWidth && viewport.height == mHeight &&
        copyEye(static_cast<std::size_t>(first), viewport))
        return;
    uploadEye(static_cast<std::size_t>(first));
    uploadEye(static_cast<std::size_t>(second));
    const bool layered = mLayers.has_value();
    const ShaderProgram& program = programFor(pass, layered);
    program.use();
    if (layered) {
        glActiveTexture(GL_TEXTURE3);
        glBindTexture(GL_TEXTURE_2D, (*mLayers)[static_cast<std::size_t>(second)].texture);
        glActiveTexture(GL_TEXTURE2);
        glBindTexture(GL_TEXTURE_2D, (*mLayers)[static_cast<std::size_t>(first)].texture);
    }
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, mEyes[static_cast<std::size_t>(second)].name());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, mEyes[static_cast<std::size_t>(first)].name());
    glUniform2i(program.location("uEyeSize"), mWidth, mHeight);
    glUniform4i(program.location("uViewport"), viewport.x, viewport.y, viewport.width, viewport.height);
    glUniform2f(program.location("uScale"),
                static_cast<float>(pictureWidth) / static_cast<float>(viewport.width),
                static_cast<float>(pictureHeight) / static_cast<float>(viewport.height));
    glUniform2i(program.location("uTurn"), turnX, turnY);
    glUniform1i(program.location("uLinear"), setting.linearAnaglyph);
    const AnaglyphMatrix& matrix = anaglyphMatrix(setting.mode);
    glUniformMatrix3fv(program.location("uFromFirst"), 1, GL_FALSE, eyePart(matrix, 0).data());
    glUniformMatrix3fv(program.location("uFromSecond"), 1, GL_FALSE, eyePart(matrix, 3).data());
    glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glBindVertexArray(mVertices.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace stereonav
