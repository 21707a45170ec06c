#include "app/view/window/kept_window.h"

#include <algorithm>
#include <string>
#include <vector>

#include "app/view/notices.h"
#include "app/view/screen_sizes.h"
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

void KeptWindow::restore(PanelStage& stage, ScreenSizes& screens, Notices& notices) {
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
    stage.panels().setFolder(mConfig.lastFolder);
    screens.setKept(mConfig.screens);
    if (contains(mConfig.openPanels, kOwnWindow)) notices.tryTo([&] { stage.toggleControls(); });
}

void KeptWindow::keep(const PanelStage& stage, const ScreenSizes& screens, bool speedByDistance,
                      float contentScale) const {
    WindowConfig config = mConfig;
    const InterfaceLook& look = stage.overPicture().look();
    const ShownPanels& shown = stage.panels().shown();
    config.theme = look.dark ? "dark" : "light";
    if (mConfig.scale || look.scale != contentScale) config.scale = look.scale;
    config.rightWidth = shown.side.width * kInterfaceFontPixels;
    config.leftWidth = shown.left.width * kInterfaceFontPixels;
    config.openPanels.clear();
    if (shown.side.shown) config.openPanels.emplace_back(kSidePanels);
    if (shown.left.shown) config.openPanels.emplace_back(kLeftPanels);
    if (stage.controls()) config.openPanels.emplace_back(kOwnWindow);
    config.lastFolder = stage.panels().folder();
    config.placeLabels = shown.placeNames;
    config.speedByDistance = speedByDistance;
    config.screens = screens.kept();
    if (!(config == mConfig)) writeWindowConfig(config);
}

}  // namespace stereonav
