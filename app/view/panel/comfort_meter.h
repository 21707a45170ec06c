// The frame's parallax beside the limits of comfort.
#pragma once

#include "app/view/view_display.h"

namespace stereonav {

float comfortMeterWidth();  // in units of the interface
// Draws a bar in a line of text: the range of parallax around the middle of the limits, with a warning where
// it exceeds them.
void drawComfortMeter(const ViewDisplay& display, const ViewFrame& frame);

}  // namespace stereonav
