// The lines on the screen's size in the panel View and stereo. Where the monitor does not report how wide it
// is, they ask for it: never over the picture.
#pragma once

#include "app/view/panel/panel_parts.h"

namespace stereonav {

// Asks once for each monitor, while two eyes are shown: for one nothing depends on the size.
void drawScreen(const PanelParts& parts);

}  // namespace stereonav
