// The panels at the right: the table's options that go with the scene, under their headings, and what a frame
// costs.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

void drawSidePanels(PanelHost& host);

}  // namespace stereonav
