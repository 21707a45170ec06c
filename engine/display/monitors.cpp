#include "engine/display/monitors.h"

#define GLFW_INCLUDE_NONE
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/base/error.h"

namespace stereonav {
namespace {

// The length that two spans of widths or heights share.
long long sharedLength(int a, int aLength, int b, int bLength) {
    const long long begin = std::max(a, b);
    const long long end = std::min(static_cast<long long>(a) + aLength, static_cast<long long>(b) + bLength);
    return std::max(end - begin, 0LL);
}

// Returns the gap between two spans that share nothing; else 0.
double gapBetween(int a, int aLength, int b, int bLength) {
    const double before = static_cast<double>(b) - (static_cast<double>(a) + aLength);
    const double after = static_cast<double>(a) - (static_cast<double>(b) + bLength);
    return std::max({before, after, 0.0});
}

std::string lowered(std::string_view text) {
    std::string low(text);
    for (char& c : low) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return low;
}

Monitor factsOf(GLFWmonitor* handle) {
    Monitor monitor;
    if (const char* name = glfwGetMonitorName(handle)) monitor.name = name;
    glfwGetMonitorPos(handle, &monitor.area.x, &monitor.area.y);
    if (const GLFWvidmode* mode = glfwGetVideoMode(handle)) {
        monitor.area.width = mode->width;
        monitor.area.height = mode->height;
        monitor.refreshRate = std::max(mode->refreshRate, 0);
    }
    ScreenRect& free = monitor.workArea;
    glfwGetMonitorWorkarea(handle, &free.x, &free.y, &free.width, &free.height);
    glfwGetMonitorPhysicalSize(handle, &monitor.width_mm, &monitor.height_mm);
    float x = 1, y = 1;
    glfwGetMonitorContentScale(handle, &x, &y);
    monitor.contentScale = std::isfinite(x) && x > 0 ? x : 1;
    return monitor;
}

Error unknownMonitor(std::span<const Monitor> monitors, std::string_view text, const char* what) {
    return {"", "full screen", fmt::format("{} \"{}\"", what, text),
            monitors.empty() ? "none is connected" : "the monitors are " + monitorList(monitors)};
}

}  // namespace

std::vector<Monitor> monitors() {
    int count = 0;
    GLFWmonitor** const handles = glfwGetMonitors(&count);
    std::vector<Monitor> list;
    for (int n = 0; handles && n < count; ++n) list.push_back(factsOf(handles[n]));
    return list;
}

const std::vector<Monitor>& recentMonitors() {
    constexpr double kAge = 0.25;  // seconds
    static std::vector<Monitor> list;
    static double made = 0;
    const double now = glfwGetTime();  // which begins anew with GLFW
    if (list.empty() || !(now >= made && now - made < kAge)) {
        list = monitors();
        made = now;
    }
    return list;
}

std::optional<std::size_t> monitorUnder(std::span<const Monitor> monitors, const ScreenRect& window) {
    std::optional<std::size_t> best;
    long long bestArea = 0;
    double bestGap = 0;
    for (std::size_t n = 0; n < monitors.size(); ++n) {
        const ScreenRect& m = monitors[n].area;
        const long long area = sharedLength(window.x, window.width, m.x, m.width) *
                               sharedLength(window.y, window.height, m.y, m.height);
        const double gap = std::hypot(gapBetween(window.x, window.width, m.x, m.width),
                                      gapBetween(window.y, window.height, m.y, m.height));
        if (best && (area < bestArea || (area == bestArea && gap >= bestGap))) continue;
        best = n;
        bestArea = area;
        bestGap = gap;
    }
    return best;
}

std::optional<std::size_t> monitorNamed(std::span<const Monitor> monitors, std::string_view text) {
    if (text == "auto") return std::nullopt;
    const bool number = !text.empty() && std::all_of(text.begin(), text.end(),
                                                     [](unsigned char c) { return std::isdigit(c) != 0; });
    if (number) {
        // Longer numbers are larger than any count.
        const std::size_t n = text.size() < 6 ? std::stoul(std::string(text)) : 0;
        if (n >= 1 && n <= monitors.size()) return n - 1;
        throw unknownMonitor(monitors, text, "there is no monitor");
    }
    const std::string wanted = lowered(text);
    std::vector<std::size_t> parts;
    for (std::size_t n = 0; n < monitors.size(); ++n) {
        const std::string name = lowered(monitors[n].name);
        if (name == wanted && !wanted.empty()) return n;
        if (!wanted.empty() && name.find(wanted) != std::string::npos) parts.push_back(n);
    }
    if (parts.size() == 1) return parts.front();
    throw unknownMonitor(monitors, text,
                         parts.empty() ? "there is no monitor" : "several monitors are called");
}

std::string monitorList(std::span<const Monitor> monitors) {
    std::string list;
    for (std::size_t n = 0; n < monitors.size(); ++n)
        list += fmt::format("{}{} {} ({}x{})", n ? ", " : "", n + 1, monitors[n].name, monitors[n].area.width,
                            monitors[n].area.height);
    return list;
}

glm::ivec2 placeOnMonitor(const ScreenRect& window, const Monitor& monitor, double scale) {
    if (!(scale > 0) || !std::isfinite(scale)) scale = 1;
    const auto pixels = [&](int from, int to) {
        return static_cast<int>(std::lround((static_cast<double>(to) - from) * scale));
    };
    return {pixels(monitor.area.x, window.x), pixels(monitor.area.y, window.y)};
}

}  // namespace stereonav
