// What is painted on the ground and can be exchanged in the picture: contours that are dragged, what is seen
// from a place.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

// Nothing where the scene's paint can not be exchanged.
void drawGroundPaint(PanelHost& host, const Scene& scene);

// --paint hours of a date, "2026-12-21", as a button.
void drawHoursButton(PanelHost& host, const std::string& date);

}  // namespace stereonav
