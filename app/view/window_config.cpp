#include "app/view/window_config.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/view/kept_file.h"
#include "engine/base/error.h"
#include "engine/text/toml_document.h"

namespace stereonav {
namespace {

constexpr const char* kThemes[] = {"dark", "light"};
constexpr std::size_t kMostPanels = 100, kLongestPanel = 100, kLongestMonitor = 200;

// Returns a basic string of TOML.
std::string tomlText(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            result += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
        else
            result += c;
    }
    return result + "\"";
}

void readOptional(TomlSection& section, const char* key, std::optional<double>& value,
                  const NumberRange& range) {
    double number = range.low - 1;
    section.read(key, number, range);
    if (number >= range.low) value = number;  // otherwise it is not there, or has been noted
}

void readTheme(TomlSection& window, std::string& theme) {
    std::string name = theme;
    window.read("theme", name);
    if (std::find(std::begin(kThemes), std::end(kThemes), name) != std::end(kThemes))
        theme = name;
    else
        window.note("theme", fmt::format("expected dark or light, got \"{}\"", name), "choose one of them");
}

// A place has all four numbers.
void readPlace(TomlSection& window, std::optional<ScreenRect>& place) {
    constexpr std::int64_t kFarthest = 100'000, kMissing = kFarthest + 1;
    std::int64_t x = kMissing, y = kMissing, width = 0, height = 0;
    window.read("x", x, -kFarthest, kFarthest);
    window.read("y", y, -kFarthest, kFarthest);
    window.read("width", width, 1, kFarthest);
    window.read("height", height, 1, kFarthest);
    if (x == kMissing || y == kMissing || width == 0 || height == 0) return;
    place = {static_cast<int>(x), static_cast<int>(y), static_cast<int>(width), static_cast<int>(height)};
}

void readMode(TomlSection& stereo, std::optional<ShownMode>& mode) {
    if (!stereo.has("mode")) return;
    std::string name;
    bool on = false;
    stereo.read("mode", name);
    stereo.read("on", on);
    if (const auto known = outputModeFromName(name))
        mode = {*known, on};
    else
        stereo.note("mode", fmt::format("there is no output mode \"{}\"", name), "leave it out");
}

std::vector<std::string> panelNames(std::vector<std::string> names) {
    if (names.size() > kMostPanels) names.resize(kMostPanels);
    std::erase_if(names, [](const std::string& name) { return name.empty() || name.size() > kLongestPanel; });
    return names;
}

void readSections(TomlDocument& document, WindowConfig& config) {
    TomlSection window = document.section("window");
    readTheme(window, config.theme);
    readOptional(window, "scale", config.scale, kWindowScaleRange);
    window.read("place_labels", config.placeLabels);
    readPlace(window, config.place);
    window.read("maximised", config.maximised);
    window.read("figures", config.figures);
    std::string folder;
    window.read("last_folder", folder);
    config.lastFolder = folder;
    TomlSection panels = document.section("panels");
    panels.read("left_width", config.leftWidth, kPanelWidthRange);
    panels.read("right_width", config.rightWidth, kPanelWidthRange);
    config.openPanels = panelNames(panels.texts("open"));
    TomlSection flight = document.section("flight");
    flight.read("speed_by_distance", config.speedByDistance);
    TomlSection stereo = document.section("stereo");
    readMode(stereo, config.mode);
    for (TomlSection& section : document.sections("screen")) {
        KeptScreen screen;
        if (section.has("monitor")) section.read("monitor", screen.monitor);
        readOptional(section, "width_mm", screen.width_mm, kScreenWidthRange);
        readOptional(section, "viewing_distance_mm", screen.viewingDistance_mm, kViewingDistanceRange);
        if (config.screens.size() < kMostScreens) config.screens.push_back(std::move(screen));
    }
}

std::string tomlOf(const KeptScreen& screen) {
    std::string text = "\n[[screen]]\n";
    if (!screen.monitor.empty())
        text += "monitor = " + tomlText(keptText(screen.monitor, kLongestMonitor)) + "\n";
    if (screen.width_mm) text += fmt::format("width_mm = {}\n", *screen.width_mm);
    if (screen.viewingDistance_mm)
        text += fmt::format("viewing_distance_mm = {}\n", *screen.viewingDistance_mm);
    return text;
}

std::string tomlOf(const WindowConfig& config) {
    std::string text = "# The window of stereonav, as it was left.\n\n[window]\n";
    text += "theme = " + tomlText(config.theme) + "\n";
    if (config.scale) text += fmt::format("scale = {}\n", *config.scale);
    text += fmt::format("place_labels = {}\n", config.placeLabels);
    if (const auto& at = config.place)
        text += fmt::format("x = {}\ny = {}\nwidth = {}\nheight = {}\n", at->x, at->y, at->width, at->height);
    text += fmt::format("maximised = {}\n", config.maximised);
    text += fmt::format("figures = {}\n", config.figures);
    const std::string folder = config.lastFolder.string();
    if (!folder.empty() && isUtf8(folder))  // other bytes are not valid in TOML
        text += "last_folder = " + tomlText(folder) + "\n";
    text +=
        fmt::format("\n[panels]\nleft_width = {}\nright_width = {}\n", config.leftWidth, config.rightWidth);
    // Empty lists are not written, since they would not be read.
    for (std::size_t k = 0; k < config.openPanels.size(); ++k)
        text += (k > 0 ? ", " : "open = [") + tomlText(keptText(config.openPanels[k], kLongestPanel));
    if (!config.openPanels.empty()) text += "]\n";
    text += fmt::format("\n[flight]\nspeed_by_distance = {}\n", config.speedByDistance);
    if (config.mode)
        text += fmt::format("\n[stereo]\nmode = \"{}\"\non = {}\n", infoOf(config.mode->mode).shortName,
                            config.mode->stereo);
    for (const KeptScreen& screen : config.screens) text += tomlOf(screen);
    return text;
}

}  // namespace

std::filesystem::path windowConfigFile() {
    const std::filesystem::path folder = configFolder();
    return folder.empty() ? folder : folder / "window.toml";
}

ReadConfig readWindowConfig(const std::filesystem::path& file) {
    ReadConfig read;
    std::error_code code;
    if (file.empty() || !std::filesystem::exists(file, code)) return read;
    std::optional<TomlDocument> document;
    try {
        document.emplace(file);
    } catch (const Error& error) {
        read.problem = error.what();
        setAside(file);
        return read;
    }
    try {
        readSections(*document, read.config);
        document->finish();
    } catch (const Error& error) {
        read.problem = error.what();
    }
    return read;
}

std::string writeWindowConfig(const WindowConfig& config, const std::filesystem::path& file) {
    try {
        writeKept(file, tomlOf(config));
    } catch (const Error& error) {
        return std::string("what was set is not kept: ") + error.what();
    }
    return "";
}

}  // namespace stereonav
