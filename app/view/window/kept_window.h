// State of the window, kept between runs (window_config.h).
#pragma once

#include "app/view/window_config.h"

namespace stereonav {

class Notices;
class PanelStage;
class ViewDisplay;
class Window;

class KeptWindow {
public:
    // Restores the kept state; errors in it become notices. sized: the window's size was given, and its place
    // is left to the desktop.
    void restore(Window& window, PanelStage& stage, ViewDisplay& display, Notices& notices, bool sized);
    // Keeps the present state; writes nothing where nothing has changed.
    void keep(const Window& window, const PanelStage& stage, const ViewDisplay& display,
              bool speedByDistance) const;

    bool speedByDistance() const { return mConfig.speedByDistance; }

private:
    void keepPlace(const Window& window, WindowConfig& config) const;

    WindowConfig mConfig;              // state as it was read
    std::optional<ScreenRect> mGiven;  // place of a window whose size was given
};

}  // namespace stereonav
