// What is drawn into which back buffer before a swap: one picture of both eyes, the eye whose turn it is, or
// each eye into its own buffer.
#pragma once

#include <vector>

#include "engine/image/stereo_compose.h"

namespace stereonav {

enum class BackBuffer { Both, Left, Right };

// One drawing of the composed picture.
struct EyePass {
    ComposeSetting setting;  // with a mode that is composed
    BackBuffer buffer = BackBuffer::Both;

    bool operator==(const EyePass&) const = default;
};

// Returns what to draw. turn: for alternating modes, 0 the eye that comes first, 1 the other one. Where the
// window has no quad buffer (Window::quadBuffered), that mode is the left eye alone.
std::vector<EyePass> eyePasses(const ComposeSetting& setting, int turn, bool quadBuffered);

// Chooses the buffer that is drawn into from here on; needs a current context, whose buffers are a window's.
void drawInto(BackBuffer buffer);

}  // namespace stereonav
