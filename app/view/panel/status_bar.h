// The line of figures at the bottom, what just happened over it, and what needs attention.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

// left, right: units of the interface that panels take there. Its height.
float drawStatusBar(PanelHost& host, float left, float right);
// What is being waited for, with a button that cancels; a failure, which stays; a notice, which goes. From
// `top` down.
void drawNotices(PanelHost& host, float left, float right, float top);

}  // namespace stereonav
