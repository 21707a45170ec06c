#include "app/view/panel/panel_texture.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <vector>

namespace stereonav {

void PanelTexture::set(const Plane<PackedColor>& picture, bool smooth) {
    if (picture.empty()) return reset();
    const auto& bytes = srgbByteFromPacked();
    const std::size_t pixels =
        static_cast<std::size_t>(picture.width()) * static_cast<std::size_t>(picture.height());
    std::vector<std::uint8_t> rgba(4 * pixels, 255);
    std::uint8_t* to = rgba.data();
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x, to += 4) {
            const PackedColor color = picture.at(x, y);
            for (int channel = 0; channel < 3; ++channel) to[channel] = bytes[color >> (10 * channel) & 1023];
        }
    if (!mTexture) mTexture.emplace();
    mWidth = picture.width();
    mHeight = picture.height();
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
    return mTexture ? reinterpret_cast<void*>(static_cast<std::intptr_t>(mTexture->name())) : nullptr;
}

}  // namespace stereonav
