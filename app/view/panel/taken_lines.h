// Lines that are not clicked but taken: tracks that are drawn on the ground, and the flight.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

void drawTakenLines(PanelHost& host);

}  // namespace stereonav
