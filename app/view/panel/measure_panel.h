// A line over the surface: its places, what it measures, and its profile.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

void drawMeasurePanel(PanelHost& host);

}  // namespace stereonav
