// Which picture is drawn into which back buffer before a swap: one picture of both eyes, the eye whose turn
// it is, or each eye into its own buffer.
#pragma once

#include <vector>

#include "engine/image/stereo_compose.h"

namespace stereonav {

enum class BackBuffer { Both, Left, Right };

// One drawing of the composed picture.
struct EyePass {
    ComposeSetting setting;  // its mode is one that is composed
    BackBuffer buffer = BackBuffer::Both;

    bool operator==(const EyePass&) const = default;
};

// Returns what to draw. turn: for alternating modes, 0 the eye that comes first, 1 the other one. Where the
// window has no quad buffer (Window::quadBuffered), that mode is the left eye alone.
std::vector<EyePass> eyePasses(const ComposeSetting& setting, int turn, bool quadBuffered);

// Selects the buffer for drawing from here on; requires a current context of a window.
void drawInto(BackBuffer buffer);

}  // namespace stereonav
