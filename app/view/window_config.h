// Settings of the window itself, for all scenes: window.toml in configFolder().
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/view/shown_mode.h"
#include "engine/display/monitors.h"
#include "engine/text/number_range.h"

namespace stereonav {

constexpr NumberRange kWindowScaleRange = within(0.5, 4);
constexpr NumberRange kPanelWidthRange = within(80, 4000, "pixels");  // at scale 1
constexpr NumberRange kScreenWidthRange = within(20, 50'000, "mm");   // from a phone to a wall
constexpr NumberRange kViewingDistanceRange = within(50, 200'000, "mm");

// Settings of one monitor; an entry says that its size was asked for.
struct KeptScreen {
    std::string monitor;
    std::optional<double> width_mm, viewingDistance_mm;

    bool operator==(const KeptScreen&) const = default;
};
constexpr std::size_t kMostScreens = 32;

struct WindowConfig {
    std::string theme = "dark";   // dark or light
    std::optional<double> scale;  // empty: the desktop's
    double leftWidth = 260, rightWidth = 300;
    std::vector<std::string> openPanels;  // by name
    std::filesystem::path lastFolder;     // "" where there is none
    bool speedByDistance = false;
    bool placeLabels = true;
    bool figures = false;             // in the status bar
    std::optional<ScreenRect> place;  // the window's on the desktop, while it is not maximised
    bool maximised = false;
    std::optional<ShownMode> mode;    // the one that was shown last
    std::vector<KeptScreen> screens;  // used last first

    bool operator==(const WindowConfig&) const = default;
};

std::filesystem::path windowConfigFile();  // "" where there is no home directory

struct ReadConfig {
    WindowConfig config;
    std::string problem;  // one line; "": none
};

// Reads the settings. Invalid or unknown ones are reported in one line, and have their defaults; a file that
// is no TOML is set aside. Throws no Error.
ReadConfig readWindowConfig(const std::filesystem::path& file = windowConfigFile());
// Writes the settings; returns "" or why it failed, one line. Keys that this program does not know are lost.
std::string writeWindowConfig(const WindowConfig& config,
                              const std::filesystem::path& file = windowConfigFile());

}  // namespace stereonav
