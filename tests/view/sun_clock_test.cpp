// The sun by date, time and place: equal to the engine's, with usual days and clocks.
#include "app/view/sun_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "app/view/setting_texts.h"
#include "engine/light/skies/sun_position.h"

namespace stereonav {
namespace {

constexpr double kSunDegree = std::numbers::pi / 180;
constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

SunClock at(const std::string& date, const std::string& time, double offset, double north_deg,
            double east_deg) {
    SunClock clock;
    clock.offset = offset;
    clock.place = {north_deg * kSunDegree, east_deg * kSunDegree};
    return *withTime(*withDate(clock, date), time);
}

TEST(SunClock, IsTheEnginesSun) {
    const SunClock clock = at("2003-10-17", "12:30", -7, 39.742476, -105.1786);
    EXPECT_EQ(secondsOf(clock), secondsFromUtc(2003, 10, 17, 19, 30));
    const SunSeen seen = sunSeenAt(secondsOf(clock), clock.place.latitude, clock.place.longitude);
    const SunThen sun = sunThen(clock, 0);
    EXPECT_EQ(sun.trueAzimuth, seen.azimuth);
    EXPECT_EQ(sun.world.elevation, seen.elevation);
    EXPECT_NEAR(std::remainder(sun.world.azimuth - seen.azimuth, 2 * std::numbers::pi), 0, 1e-12);
    EXPECT_FALSE(sun.below);
    EXPECT_NEAR(sun.rises.value(), 6 + 12 / 60.0, 0.03) << "NREL/TP-560-34302: 6:12:43";
    EXPECT_NEAR(sun.sets.value(), 17 + 20 / 60.0, 0.03);
}

TEST(SunClock, TurnsWithTheMapsNorth) {
    const SunClock clock = at("2024-06-21", "15:00", 2, 47, 8);
    for (const double north : {0.03, -0.03, 3.0, -3.0}) {
        const SunThen straight = sunThen(clock, 0), turned = sunThen(clock, north);
        EXPECT_NEAR(
            std::remainder(turned.world.azimuth - straight.world.azimuth - north, 2 * std::numbers::pi), 0,
            1e-12);
        EXPECT_EQ(turned.trueAzimuth, straight.trueAzimuth);
        EXPECT_LE(std::abs(turned.world.azimuth), std::numbers::pi) << "as --sun takes it";
    }
    EXPECT_EQ(sunThen(clock, kNoTime).world.azimuth, sunThen(clock, 0).world.azimuth);
}

TEST(SunClock, IsTakenByTheOption) {
    for (int hour = 0; hour < 24; ++hour) {
        SunClock clock = at("2024-12-21", "00:00", 0, -33.9, 151.2);
        clock.hour = hour;
        const SunThen sun = sunThen(clock, 0.01);
        const ViewOptions options = viewOptionsOf({{"sun", {sunOptionText(sun.world)}}});
        ASSERT_TRUE(options.scene.sun);
        EXPECT_NEAR(options.scene.sun->azimuth, sun.world.azimuth, 0.0006 * kSunDegree);
        EXPECT_NEAR(options.scene.sun->elevation, sun.world.elevation, 0.0006 * kSunDegree);
    }
}

TEST(SunClock, KnowsPolarDaysAndNights) {
    const SunThen night = sunThen(at("2024-12-21", "12:00", 1, 78, 15), 0);
    EXPECT_TRUE(night.below);
    EXPECT_FALSE(night.rises || night.sets || night.staysUp);
    EXPECT_NE(describe(night).find("below the horizon"), std::string::npos);
    EXPECT_NE(describe(night).find("does not rise"), std::string::npos);
    const SunThen day = sunThen(at("2024-06-21", "00:00", 1, 78, 15), 0);
    EXPECT_FALSE(day.below);
    EXPECT_TRUE(day.staysUp);
    EXPECT_NE(describe(day).find("does not set"), std::string::npos);
    for (const double pole : {90.0, -90.0}) {
        const SunThen sun = sunThen(at("2024-06-21", "12:00", 0, pole, 0), 0);
        EXPECT_NEAR(std::abs(sun.world.elevation), 23.44 * kSunDegree, 0.1 * kSunDegree);
        EXPECT_EQ(sun.below, pole < 0);
    }
}

TEST(SunClock, GoesOverTheEndsOfYears) {
    EXPECT_EQ(secondsOf(at("2023-12-31", "23:30", -5, 0, 0)), secondsFromUtc(2024, 1, 1, 4, 30));
    EXPECT_EQ(secondsOf(at("2024-01-01", "00:30", 14, 0, 0)), secondsFromUtc(2023, 12, 31, 10, 30));
    SunClock leap = at("2024-12-31", "12:00", 0, 0, 0);
    EXPECT_EQ(leap.day, 366);
    leap.year = 2023;
    EXPECT_EQ(dateText(tidy(leap)), "2023-12-31") << "a year without that day";
    EXPECT_EQ(at("2024-02-29", "12:00", 0, 0, 0).day, 60);
    EXPECT_EQ(daysIn(2000), 366);
    EXPECT_EQ(daysIn(1900), 365);
    for (const int year : {1, 9999})
        for (const int day : {1, daysIn(year)}) {
            SunClock edge = tidy({year, day, 12, 14, {0, 0}});
            EXPECT_TRUE(std::isfinite(sunThen(edge, 0).world.elevation)) << dateText(edge);
        }
}

TEST(SunClock, ReadsDatesAndTimesThatAreSome) {
    const SunClock clock;
    for (const char* date : {"2024-06-21", "0001-01-01", "9999-12-31", "2024-6-1"})
        EXPECT_TRUE(withDate(clock, date)) << date;
    for (const char* date :
         {"", "2023-02-29", "2024-13-01", "2024-00-10", "2024-06-31", "0000-01-01", "10000-01-01", "2024-06",
          "2024-06-21x", "21.6.2024", "-2024-06-21", "nan", "2024--6-21"})
        EXPECT_FALSE(withDate(clock, date)) << date;
    EXPECT_EQ(dateText(*withDate(clock, "2024-6-1")), "2024-06-01");
    EXPECT_EQ(timeText(withTime(clock, "7:05")->hour), "07:05");
    for (const char* time : {"", "24:00", "12:60", "12", "12:00:00", "-1:00", "x"})
        EXPECT_FALSE(withTime(clock, time)) << time;
    for (int minute = 0; minute < 24 * 60; ++minute) {
        const std::string text = timeText(minute / 60.0);
        EXPECT_EQ(timeText(withTime(clock, text)->hour), text);
    }
    EXPECT_EQ(timeText(kNoTime), "00:00");
}

TEST(SunClock, IsBroughtIntoRange) {
    const SunClock wild = tidy({-5, 9999, kNoTime, 1e9, {kNoTime, -std::numeric_limits<double>::infinity()}});
    EXPECT_EQ(wild, tidy(wild));
    EXPECT_TRUE(std::isfinite(sunThen(wild, 0).world.azimuth));
    EXPECT_LT(tidy({2024, 1, 24, 0, {}}).hour, 24);
    EXPECT_TRUE(std::isfinite(sunThen({20000, -7, kNoTime, kNoTime, {5, 50}}, kNoTime).world.elevation));
}

TEST(SunClock, BeginsNow) {
    const double seconds = secondsFromUtc(2024, 6, 21, 22, 45, 12);
    const SunClock clock = clockAt(seconds, {0.8, 100 * kSunDegree});
    EXPECT_EQ(clock.offset, 7);
    EXPECT_EQ(dateText(clock), "2024-06-22");
    EXPECT_EQ(timeText(clock.hour), "05:45");
    EXPECT_NEAR(secondsOf(clock), seconds, 60);
    EXPECT_EQ(clockAt(kNoTime, {kNoTime, kNoTime}), tidy(clockAt(kNoTime, {kNoTime, kNoTime})));
}

}  // namespace
}  // namespace stereonav
