// How the window was left, kept between runs (window_config.h).
#pragma once

#include "app/view/window_config.h"

namespace stereonav {

class Notices;
class PanelStage;
class PictureMarks;
class ScreenSizes;

class KeptWindow {
public:
    // Reads what was kept, and makes the window so. What is wrong in it is told.
    void restore(PanelStage& stage, ScreenSizes& screens, PictureMarks& marks, Notices& notices);
    // Keeps it as it is now; writes nothing where nothing was changed.
    void keep(const PanelStage& stage, const ScreenSizes& screens, const PictureMarks& marks,
              bool speedByDistance, float contentScale) const;

    bool speedByDistance() const { return mConfig.speedByDistance; }

private:
    WindowConfig mConfig;  // as it was read
};

}  // namespace stereonav
