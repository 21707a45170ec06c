#include "engine/display/plain_eyes.h"

namespace stereonav {
namespace {

// Blue lowest, opaque: the order of bytes that windows have, so that Mesa's drivers copy bytes.
void encode(const PackedColor* from, int count, std::uint32_t* to) {
    const auto& table = srgbByteFromPacked();
    for (int n = 0; n < count; ++n) {
        const PackedColor c = from[n];
        to[n] = 0xff000000u | static_cast<std::uint32_t>(table[c & 1023]) << 16 |
                static_cast<std::uint32_t>(table[c >> 10 & 1023]) << 8 | table[c >> 20 & 1023];
    }
}

}  // namespace

void PlainEyes::upload(std::size_t eye, const Plane<PackedColor>& colors) {
    const int width = colors.width(), height = colors.height();
    if (!mStores[eye]) mStores[eye] = std::make_unique<Store>();
    Store& store = *mStores[eye];
    glBindTexture(GL_TEXTURE_2D, store.texture.name());
    if (store.width != width || store.height != height) {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                     nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        GLint before = 0;
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, store.framebuffer.name());
        glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, store.texture.name(),
                               0);
        store.complete = glCheckFramebufferStatus(GL_READ_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
        glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
        store.width = width;
        store.height = height;
    }
    mBytes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
        encode(colors.row(y), width,
               mBytes.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                    mBytes.data());
}

// Rows of a window are counted from below, those of the texture from the top: turned over.
bool PlainEyes::copy(std::size_t eye, int x, int y) const {
    if (!mStores[eye] || !mStores[eye]->complete) return false;
    const Store& store = *mStores[eye];
    GLint before = 0;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, store.framebuffer.name());
    glBlitFramebuffer(0, 0, store.width, store.height, x, y + store.height, x + store.width, y,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
    return true;
}

}  // namespace stereonav
