#include "app/view/kept_window.h"

#include <algorithm>
#include <string>
#include <vector>

#include "app/view/notices.h"
#include "app/view/panel_stage.h"
#include "app/view/picture_marks.h"
#include "app/view/screen_sizes.h"

namespace stereonav {
namespace {

constexpr const char* kSidePanels = "side";
constexpr const char* kLeftPanels = "left";
constexpr const char* kOwnWindow = "own window";

bool contains(const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void KeptWindow::restore(PanelStage& stage, ScreenSizes& screens, PictureMarks& marks, Notices& notices) {
    const ReadConfig read = readWindowConfig();
    mConfig = read.config;
    notices.fail(read.problem);
    InterfaceLook look = stage.overPicture().look();
    look.dark = mConfig.theme != "light";
    if (mConfig.scale) look.scale = static_cast<float>(*mConfig.scale);
    stage.overPicture().setLook(look);
    Panels& panels = stage.panels();
    panels.setSide(contains(mConfig.openPanels, kSidePanels), static_cast<float>(mConfig.rightWidth));
    panels.setLeft(contains(mConfig.openPanels, kLeftPanels), static_cast<float>(mConfig.leftWidth));
    panels.setFolder(mConfig.lastFolder);
    screens.setKept(mConfig.screens);
    marks.showNames(mConfig.placeLabels);
    if (contains(mConfig.openPanels, kOwnWindow)) notices.tryTo([&] { stage.toggleControls(); });
}

void KeptWindow::keep(const PanelStage& stage, const ScreenSizes& screens, const PictureMarks& marks,
                      bool speedByDistance, float contentScale) const {
    WindowConfig config = mConfig;
    const InterfaceLook& look = stage.overPicture().look();
    const Panels& panels = stage.panels();
    config.theme = look.dark ? "dark" : "light";
    if (mConfig.scale || look.scale != contentScale) config.scale = look.scale;
    config.rightWidth = panels.sideWidth();
    config.leftWidth = panels.leftWidth();
    config.openPanels.clear();
    if (panels.sideShown()) config.openPanels.emplace_back(kSidePanels);
    if (panels.leftShown()) config.openPanels.emplace_back(kLeftPanels);
    if (stage.controls()) config.openPanels.emplace_back(kOwnWindow);
    config.lastFolder = panels.folder();
    config.placeLabels = marks.showsNames();
    config.speedByDistance = speedByDistance;
    config.screens = screens.kept();
    if (!(config == mConfig)) writeWindowConfig(config);
}

}  // namespace stereonav
