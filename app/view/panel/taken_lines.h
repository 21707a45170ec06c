// Lines that are taken instead of clicked: tracks that are drawn on the ground, and the flight.
#pragma once

#include "app/view/measured_line.h"
#include "app/view/session.h"

namespace stereonav {

void drawTakenLines(ViewSession& session, MeasuredLine& line);

}  // namespace stereonav
