#include "engine/display/eye_passes.h"

#include <epoxy/gl.h>

namespace stereonav {

std::vector<EyePass> eyePasses(const ComposeSetting& setting, int turn, bool quadBuffered) {
    const OutputModeInfo& info = infoOf(setting.mode);
    const auto oneEye = [&](bool right, BackBuffer buffer) {
        // The swap is kept, so that it is the presenter's alone to exchange eyes.
        return EyePass{
            {right ? OutputMode::Right : OutputMode::Left, setting.swapEyes, setting.linearAnaglyph}, buffer};
    };
    if (info.layout == OutputLayout::FrameSequential)
        return {oneEye(info.rightFirst != (turn % 2 != 0), BackBuffer::Both)};
    if (info.layout != OutputLayout::QuadBuffer) return {{setting, BackBuffer::Both}};
    if (!quadBuffered) return {oneEye(false, BackBuffer::Both)};
    return {oneEye(false, BackBuffer::Left), oneEye(true, BackBuffer::Right)};
}

void drawInto(BackBuffer buffer) {
    glDrawBuffer(buffer == BackBuffer::Left    ? GL_BACK_LEFT
                 : buffer == BackBuffer::Right ? GL_BACK_RIGHT
                                               : GL_BACK);
}

}  // namespace stereonav
