#include "app/view/window/kept_window.h"

#include <algorithm>
#include <string>
#include <vector>

#include "app/view/notices.h"
#include "app/view/view_display.h"
#include "app/view/window/panel_stage.h"

namespace stereonav {
namespace {

constexpr const char* kSidePanels = "side";
constexpr const char* kLeftPanels = "left";
constexpr const char* kOwnWindow = "own window";

bool contains(const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void KeptWindow::restore(Window& window, PanelStage& stage, ViewDisplay& display, Notices& notices,
                         bool sized) {
    const ReadConfig read = readWindowConfig();
    mConfig = read.config;
    notices.fail(read.problem);
    InterfaceLook look = stage.overPicture().look();
    look.dark = mConfig.theme != "light";
    if (mConfig.scale) look.scale = static_cast<float>(*mConfig.scale);
    stage.overPicture().setLook(look);
    ShownPanels& shown = stage.panels().shown();
    shown.side.shown = contains(mConfig.openPanels, kSidePanels);
    shown.left.shown = contains(mConfig.openPanels, kLeftPanels);
    shown.side.width = static_cast<float>(mConfig.rightWidth) / kInterfaceFontPixels;
    shown.left.width = static_cast<float>(mConfig.leftWidth) / kInterfaceFontPixels;
    shown.placeNames = mConfig.placeLabels;
    shown.figures = mConfig.figures;
    stage.panels().setFolder(mConfig.lastFolder);
    display.sizes().setKept(mConfig.screens);
    if (mConfig.mode) display.restoreMode(*mConfig.mode);
    if (sized)
        mGiven = window.place();
    else if (mConfig.place && !window.fullScreen())
        window.setDesktopPlace({*mConfig.place, mConfig.maximised});
    if (contains(mConfig.openPanels, kOwnWindow)) notices.tryTo([&] { stage.toggleControls(); });
}

// The size that a maximised window goes back to is the one that it had last.
void KeptWindow::keepPlace(const Window& window, WindowConfig& config) const {
    const WindowPlace now = window.desktopPlace();
    if (mGiven && now.rect.width == mGiven->width && now.rect.height == mGiven->height && !now.maximised)
        return;
    config.maximised = now.maximised;
    if (!now.maximised || !config.place) config.place = now.rect;
}

void KeptWindow::keep(const Window& window, const PanelStage& stage, const ViewDisplay& display,
                      bool speedByDistance) const {
    WindowConfig config = mConfig;
    const InterfaceLook& look = stage.overPicture().look();
    const ShownPanels& shown = stage.panels().shown();
    config.theme = look.dark ? "dark" : "light";
    if (mConfig.scale || look.scale != window.contentScale()) config.scale = look.scale;
    config.rightWidth = shown.side.width * kInterfaceFontPixels;
    config.leftWidth = shown.left.width * kInterfaceFontPixels;
    config.openPanels.clear();
    if (shown.side.shown) config.openPanels.emplace_back(kSidePanels);
    if (shown.left.shown) config.openPanels.emplace_back(kLeftPanels);
    if (stage.controls()) config.openPanels.emplace_back(kOwnWindow);
    config.lastFolder = stage.panels().folder();
    config.placeLabels = shown.placeNames;
    config.figures = shown.figures;
    config.speedByDistance = speedByDistance;
    config.screens = display.sizes().kept();
    if (const auto mode = display.modeToKeep()) config.mode = mode;
    keepPlace(window, config);
    if (!(config == mConfig)) writeWindowConfig(config);
}

}  // namespace stereonav
