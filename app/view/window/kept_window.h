// State of the window, kept between runs (window_config.h).
#pragma once

#include "app/view/window_config.h"

namespace stereonav {

class Notices;
class PanelStage;
class ScreenSizes;

class KeptWindow {
public:
    // Restores the kept state; errors in it become notices.
    void restore(PanelStage& stage, ScreenSizes& screens, Notices& notices);
    // Keeps the present state; writes nothing where nothing has changed.
    void keep(const PanelStage& stage, const ScreenSizes& screens, bool speedByDistance,
              float contentScale) const;

    bool speedByDistance() const { return mConfig.speedByDistance; }

private:
    WindowConfig mConfig;  // state as it was read
};

}  // namespace stereonav
