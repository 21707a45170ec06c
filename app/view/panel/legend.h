// What the colours mean that the scene's surfaces are painted in, as rows of a panel.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

// Nothing where the scene offers no PaintLegend.
void drawLegend(PanelHost& host, const Scene& scene);

}  // namespace stereonav
