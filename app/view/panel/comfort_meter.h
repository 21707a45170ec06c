// The frame's parallax against what is comfortable.
#pragma once

#include "app/view/view_display.h"

namespace stereonav {

float comfortMeterWidth();  // units of the interface
// A bar in a line of text: the range of parallax in the middle of the limits, warning where it leaves them.
void drawComfortMeter(const ViewDisplay& display, const ViewFrame& frame);

}  // namespace stereonav
