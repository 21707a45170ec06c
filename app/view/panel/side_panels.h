// The panels at the right: the options for this type of scene, under their headings, and the cost of a frame.
#pragma once

#include "app/view/panel/panel_parts.h"
#include "app/view/panel/sun_panel.h"
#include "app/view/panel/transfer_panel.h"

namespace stereonav {

// Panels that keep state between layouts.
struct SideTools {
    TransferPanel transfer;
    SunPanel sun;
    bool showPicture = false;  // opens "Picture" in the next layout and scrolls to it
    bool showPath = false;     // opens "Flight and path" in the next layout and scrolls to it
};

void drawSidePanels(const PanelParts& parts, SideTools& tools);

}  // namespace stereonav
