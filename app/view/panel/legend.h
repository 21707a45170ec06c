// The meaning of the colours that the scene's surfaces are painted in, as rows of a panel.
#pragma once

#include "engine/scene/scene.h"

namespace stereonav {

// Draws nothing where the scene offers no PaintLegend.
void drawLegend(const Scene& scene);

}  // namespace stereonav
