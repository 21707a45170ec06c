// Paint on the ground that can be exchanged in the picture: contours with a slider, and viewsheds.
#pragma once

#include "app/view/instruments.h"
#include "app/view/scene_changes.h"

namespace stereonav {

// Draws nothing where the scene's paint can not be exchanged.
void drawGroundPaint(SceneChanges& changes, Instruments& instruments, const ViewSession& session);

// Draws a button for --paint hours of a date, "2026-12-21".
void drawHoursButton(SceneChanges& changes, const std::string& date);

}  // namespace stereonav
