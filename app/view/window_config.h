// What a person has set of the window itself, for all scenes: window.toml in configFolder().
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/text/number_range.h"

namespace stereonav {

constexpr NumberRange kWindowScaleRange = within(0.5, 4);
constexpr NumberRange kPanelWidthRange = within(80, 4000, "pixels");  // at scale 1
constexpr NumberRange kScreenWidthRange = within(20, 50'000, "mm");   // of a phone to a wall
constexpr NumberRange kViewingDistanceRange = within(50, 200'000, "mm");

// Of one monitor; that it is there says that its size was asked for.
struct KeptScreen {
    std::string monitor;  // its name
    std::optional<double> width_mm, viewingDistance_mm;

    bool operator==(const KeptScreen&) const = default;
};
constexpr std::size_t kMostScreens = 32;

struct WindowConfig {
    std::string theme = "dark";   // dark, light
    std::optional<double> scale;  // none: the desktop's
    double leftWidth = 260, rightWidth = 300;
    std::vector<std::string> openPanels;  // by their names
    std::filesystem::path lastFolder;     // "" where there is none
    bool speedByDistance = false;
    bool placeLabels = true;
    std::vector<KeptScreen> screens;  // used last first

    bool operator==(const WindowConfig&) const = default;
};

std::filesystem::path windowConfigFile();  // "" where there is no home

struct ReadConfig {
    WindowConfig config;
    std::string problem;  // one line; "": none
};

// What is wrong or unknown is told in one line and stands at its default; a file that is no TOML is set
// aside. Throws no Error.
ReadConfig readWindowConfig(const std::filesystem::path& file = windowConfigFile());
// "" or why it could not be kept, one line. Keys that this program does not know are left out.
std::string writeWindowConfig(const WindowConfig& config,
                              const std::filesystem::path& file = windowConfigFile());

}  // namespace stereonav
