#include "engine/display/interface_still.h"

#include <glm/common.hpp>

namespace stereonav {

bool InterfaceStill::holds(std::uint64_t digest, const InterfaceOpening& opening,
                           const InterfacePart& part) const {
    return mDigest == digest && mOpening == opening && mSize == part.size;
}

void InterfaceStill::keep(std::uint64_t digest, const InterfaceOpening& opening, const InterfacePart& part,
                          const glm::ivec2& whole) {
    if (!mStore) mStore.emplace();
    if (mStored != part.size) {
        // An unsized format with the byte order of windows: Mesa's drivers then copy bytes without
        // conversion.
        glBindTexture(GL_TEXTURE_2D, mStore->texture.name());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, part.size.x, part.size.y, 0, GL_BGRA,
                     GL_UNSIGNED_INT_8_8_8_8_REV, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, mStore->framebuffer.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, mStore->texture.name(),
                               0);
        const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        mStored = complete ? part.size : glm::ivec2(0);
        if (!complete) return forget();  // without a copy the interface is drawn each time
    }
    mDigest = digest;
    mOpening = opening;
    mSize = part.size;
    mWhole = whole;
    copy(false, part);
}

void InterfaceStill::put(const InterfacePart& part) const {
    copy(true, part);
}

// Copies between window and texture. Windows count rows from the top here, OpenGL from the bottom: blits are
// turned over, which keeps the bytes in order.
void InterfaceStill::copy(bool back, const InterfacePart& part) const {
    const GLuint store = mStore->framebuffer.name();
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, back ? store : 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, back ? 0 : store);
    // Copies a piece of the part, in pixels from its top left corner.
    const auto piece = [&](int left, int top, int right, int bottom) {
        if (right <= left || bottom <= top) return;
        const int x = part.corner.x, y = mWhole.y - part.corner.y;
        if (back)
            glBlitFramebuffer(left, top, right, bottom, x + left, y - top, x + right, y - bottom,
                              GL_COLOR_BUFFER_BIT, GL_NEAREST);
        else
            glBlitFramebuffer(x + left, y - top, x + right, y - bottom, left, top, right, bottom,
                              GL_COLOR_BUFFER_BIT, GL_NEAREST);
    };
    const glm::ivec2 first = glm::clamp(mOpening.corner, glm::ivec2(0), mSize);
    const glm::ivec2 last = glm::clamp(mOpening.corner + mOpening.size, first, mSize);
    piece(0, 0, first.x, mSize.y);
    piece(last.x, 0, mSize.x, mSize.y);
    piece(first.x, 0, last.x, first.y);
    piece(first.x, last.y, last.x, mSize.y);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace stereonav
