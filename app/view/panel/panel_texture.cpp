#include "app/view/panel/panel_texture.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <vector>

#include "engine/display/interface.h"

namespace stereonav {

namespace {

// Averages the encoded bytes of a square, which is exact enough for a small picture.
void meanOf(const Plane<PackedColor>& picture, int left, int top, int step, std::uint8_t* to) {
    const auto& bytes = srgbByteFromPacked();
    unsigned sum[3] = {};
    for (int y = top; y < top + step; ++y)
        for (int x = left; x < left + step; ++x)
            for (int channel = 0; channel < 3; ++channel)
                sum[channel] += bytes[picture.at(x, y) >> (10 * channel) & 1023];
    const unsigned count = static_cast<unsigned>(step) * static_cast<unsigned>(step);
    for (int channel = 0; channel < 3; ++channel)
        to[channel] = static_cast<std::uint8_t>((sum[channel] + count / 2) / count);
}

}  // namespace

void PanelTexture::set(const Plane<PackedColor>& picture, bool smooth, int step) {
    mWidth = picture.width() / step;
    mHeight = picture.height() / step;
    if (mWidth < 1 || mHeight < 1) return reset();
    std::vector<std::uint8_t> rgba(4 * static_cast<std::size_t>(mWidth) * static_cast<std::size_t>(mHeight),
                                   255);
    std::uint8_t* to = rgba.data();
    for (int y = 0; y < mHeight; ++y)
        for (int x = 0; x < mWidth; ++x, to += 4) meanOf(picture, x * step, y * step, step, to);
    if (!mTexture) mTexture.emplace();
    noteChangedTexture();
    const GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
    glBindTexture(GL_TEXTURE_2D, mTexture->name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, mWidth, mHeight, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void* PanelTexture::id() const {
    if (!mTexture) return nullptr;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): ImGui takes a texture's name as a pointer.
    return reinterpret_cast<void*>(static_cast<std::intptr_t>(mTexture->name()));
}

}  // namespace stereonav
