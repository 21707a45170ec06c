// Coverage of a closed wall: the share that was on screen, and the way to the rest.
#pragma once

#include "app/view/asked_actions.h"
#include "app/view/live_coverage.h"
#include "app/view/session.h"

namespace stereonav {

class CoveragePanel {
public:
    // Draws the panel with its heading. coverage: null where the scene has no such wall.
    void draw(LiveCoverage* coverage, ViewSession& session, AskedActions& actions);

private:
    void drawSettings(LiveCoverage& coverage);
    void drawUnseen(LiveCoverage& coverage, ViewSession& session, AskedActions& actions);

    WallLooking mEdited;
    bool mEditing = false, mWasOn = false;
};

}  // namespace stereonav
