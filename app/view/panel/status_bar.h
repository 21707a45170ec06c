// The line of figures at the bottom, what just happened over it, and what needs attention.
#pragma once

#include "app/view/panel/panel_parts.h"

namespace stereonav {

// left, right: units of the interface that panels take there. Its height.
float drawStatusBar(const PanelParts& parts, float left, float right);
// What is being waited for, with a button that cancels; a failure, which stays; a notice, which goes. From
// `top` down.
void drawNotices(const PanelParts& parts, float left, float right, float top);

}  // namespace stereonav
