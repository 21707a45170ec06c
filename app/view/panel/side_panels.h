// The panels at the right: the table's options that go with the scene, under their headings, and what a frame
// costs.
#pragma once

#include "app/view/panel/panel_parts.h"
#include "app/view/panel/sun_panel.h"
#include "app/view/panel/transfer_panel.h"

namespace stereonav {

// Those of them that keep something from one layout to the next.
struct SideTools {
    TransferPanel transfer;
    SunPanel sun;
    bool showPicture = false;  // as showPath, of "Picture"
    bool showPath = false;     // in the next layout "Flight and path" is opened and scrolled to
};

void drawSidePanels(const PanelParts& parts, SideTools& tools);

}  // namespace stereonav
