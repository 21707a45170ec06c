// Which monitor is chosen, and from where an interleaved display counts its rows. No display needed.
#include "engine/display/monitors.h"

#include <gmock/gmock.h>

#include <limits>

#include "engine/base/error.h"

namespace stereonav {
namespace {

Monitor monitorAt(const std::string& name, const ScreenRect& area) {
    Monitor monitor;
    monitor.name = name;
    monitor.area = area;
    return monitor;
}

// Returns a desk monitor, and glasses right of it and an odd number of rows lower.
std::vector<Monitor> deskAndGlasses() {
    return {monitorAt("DP-1", {0, 0, 1921, 1080}), monitorAt("HDMI-1", {1921, 33, 3840, 1080})};
}

TEST(Monitors, TheWindowIsOnTheOneThatHasMostOfIt) {
    const auto list = deskAndGlasses();
    EXPECT_EQ(monitorUnder(list, {10, 10, 640, 480}), 0u);
    EXPECT_EQ(monitorUnder(list, {2000, 100, 640, 480}), 1u);
    EXPECT_EQ(monitorUnder(list, {1921 - 400, 100, 640, 480}), 0u) << "400 of 640 columns";
    EXPECT_EQ(monitorUnder(list, {1921 - 200, 100, 640, 480}), 1u);
    EXPECT_EQ(monitorUnder(list, {1921 - 320, 100, 640, 480}), 0u) << "the first of equals";
    EXPECT_EQ(monitorUnder(list, {0, 0, 1921 + 3840, 1113}), 1u) << "over both";
    // On none of the monitors, or without a size: the nearest is chosen.
    EXPECT_EQ(monitorUnder(list, {-5000, 40, 100, 100}), 0u);
    EXPECT_EQ(monitorUnder(list, {9000, 40, 100, 100}), 1u);
    EXPECT_EQ(monitorUnder(list, {3000, 40, 0, 0}), 1u);
    EXPECT_EQ(monitorUnder({}, {0, 0, 10, 10}), std::nullopt);
    constexpr int kFar = std::numeric_limits<int>::max(), kLow = std::numeric_limits<int>::min();
    EXPECT_EQ(monitorUnder(list, {kFar, kFar, kFar, kFar}), 1u);
    EXPECT_EQ(monitorUnder(list, {kLow, kLow, 1, 1}), 0u);
}

TEST(Monitors, AreFoundByNumberAndName) {
    const auto list = deskAndGlasses();
    EXPECT_EQ(monitorNamed(list, "auto"), std::nullopt);
    EXPECT_EQ(monitorNamed(list, "1"), 0u);
    EXPECT_EQ(monitorNamed(list, "2"), 1u);
    EXPECT_EQ(monitorNamed(list, "hdmi"), 1u);
    EXPECT_EQ(monitorNamed(list, "DP-1"), 0u);
    EXPECT_EQ(monitorNamed(list, "p-"), 0u);
    const std::vector<Monitor> alike{monitorAt("DP-1", {}), monitorAt("DP-1-2", {}), monitorAt("DP-1", {})};
    EXPECT_EQ(monitorNamed(alike, "dp-1"), 0u) << "its whole name, the first of two";
    EXPECT_EQ(monitorNamed(alike, "-2"), 1u);
}

std::string refusalOf(std::span<const Monitor> list, const std::string& text) {
    try {
        monitorNamed(list, text);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Monitors, UnknownOnesAreOneLineWithThoseThereAre) {
    const auto list = deskAndGlasses();
    for (const char* text : {"0", "3", "99999999999999999999", "-3", "TV", "", "1x"}) {
        const std::string line = refusalOf(list, text);
        EXPECT_THAT(line, testing::HasSubstr("there is no monitor \"" + std::string(text) + "\"")) << text;
        EXPECT_THAT(line, testing::HasSubstr("1 DP-1 (1921x1080), 2 HDMI-1 (3840x1080)"));
        EXPECT_EQ(line.find('\n'), std::string::npos);
    }

    EXPECT_THAT(refusalOf(list, "1"), testing::IsEmpty());
    EXPECT_THAT(refusalOf(list, "d"), testing::HasSubstr("several"));
    EXPECT_THAT(refusalOf({}, "1"), testing::HasSubstr("none is connected"));
}

TEST(Monitors, RowsCountFromTheMonitorsFirst) {
    const auto list = deskAndGlasses();
    const ScreenRect window{1930, 40, 640, 480};
    EXPECT_EQ(placeOnMonitor(window, list[1], 1), glm::ivec2(9, 7));
    EXPECT_EQ(placeOnMonitor(window, list[1], 2), glm::ivec2(18, 14)) << "twice as many pixels as units";
    EXPECT_EQ(placeOnMonitor({1920, 32, 9, 9}, list[1], 1), glm::ivec2(-1, -1)) << "over its border";
    for (const double none :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_EQ(placeOnMonitor(window, list[1], none), glm::ivec2(9, 7)) << none;
}

}  // namespace
}  // namespace stereonav
