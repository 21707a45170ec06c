// How much of a closed wall was on screen, and the way to what was not.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

class CoveragePanel {
public:
    void draw(PanelHost& host);  // with its heading, where the scene has such a wall

private:
    void drawSettings(LiveCoverage& coverage);
    void drawUnseen(PanelHost& host, LiveCoverage& coverage);

    WallLooking mEdited;
    bool mEditing = false, mWasOn = false;
};

}  // namespace stereonav
