// What is painted on the ground and can be exchanged in the picture: contours that are dragged, what is seen
// from a place.
#pragma once

#include "app/view/instruments.h"
#include "app/view/scene_changes.h"

namespace stereonav {

// Nothing where the scene's paint can not be exchanged.
void drawGroundPaint(SceneChanges& changes, Instruments& instruments, const ViewSession& session);

// --paint hours of a date, "2026-12-21", as a button.
void drawHoursButton(SceneChanges& changes, const std::string& date);

}  // namespace stereonav
