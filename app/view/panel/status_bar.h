// The status bar at the bottom, notices above it, and warnings.
#pragma once

#include "app/view/panel/panel_parts.h"

namespace stereonav {

// Draws the status bar and returns its height. left, right: widths that panels take there, in units of the
// interface. figures: whether times, ages and errors stand there in place of words.
float drawStatusBar(const PanelParts& parts, float left, float right, bool figures);
// Draws, from `top` downwards, work in progress with a button that cancels it; failures, which stay; and
// notices, which disappear.
void drawNotices(const PanelParts& parts, float left, float right, float top);

}  // namespace stereonav
