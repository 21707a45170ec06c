// The sun's place against published values and what must hold of it.
#include "engine/light/skies/sun_position.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/error_of.h"

namespace stereonav {
namespace {
using std::numbers::pi;
constexpr double kDegreesOf = 180 / pi, kRadiansOf = pi / 180;

// Meeus, example 25.a: 1992 October 13 at 0 h TD.
TEST(SunPosition, AsMeeusWorksItOut) {
    const SunOnSphere sun = sunOnSphere(2448908.5);
    EXPECT_NEAR(sun.rightAscension * kDegreesOf, 198.38083, 2e-5);
    EXPECT_NEAR(sun.declination * kDegreesOf, -7.78507, 2e-5);
}

// Reda and Andreas, Solar Position Algorithm for Solar Radiation Applications, NREL/TP-560-34302, appendix 5:
// 17 October 2003, 12:30:30 at UTC - 7 h, 820 hPa, 11 degrees Celsius. Zenith 50.11162, azimuth 194.34024
// degrees, right ascension 202.22741, declination -9.31434; sunrise 6:12:43, sunset 17:20:19.
TEST(SunPosition, AsNrelWorksItOut) {
    const double time = secondsFromUtc(2003, 10, 17, 19, 30, 30);
    const double latitude = 39.742476 * kRadiansOf, longitude = -105.1786 * kRadiansOf;
    const SunSeen sun = sunSeenAt(time, latitude, longitude, AirNow{820, 11});
    EXPECT_NEAR(90 - sun.elevation * kDegreesOf, 50.11162, 0.005);
    EXPECT_NEAR(sun.azimuth * kDegreesOf, 194.34024, 0.008);
    const SunOnSphere sphere = sunOnSphere(2440587.5 + (time + 67) / 86400);
    EXPECT_NEAR(sphere.rightAscension * kDegreesOf, 202.22741, 0.005);
    EXPECT_NEAR(sphere.declination * kDegreesOf, -9.31434, 0.005);
    const double midnight = secondsFromUtc(2003, 10, 17, 7);
    EXPECT_NEAR(nextSunrise(midnight, latitude, longitude).value() - midnight, 6 * 3600 + 12 * 60 + 43, 20);
    // The day is in UTC: there it is the evening of the 16th.
    const double day = secondsFromUtc(2003, 10, 17);
    EXPECT_NEAR(nextSunset(day, latitude, longitude).value() - day, (17 + 7 - 24) * 3600 + 20 * 60 + 19, 20);
}

// At the solstices the declination is the obliquity, at the equinoxes 0 (moments of 2020 from the
// Astronomical Almanac: 20 March 03:50, 20 June 21:44, 22 September 13:31, 21 December 10:02 UTC).
TEST(SunPosition, EquinoxesAndSolstices) {
    const auto declination = [](double seconds) {
        return sunOnSphere(2440587.5 + (seconds + 69) / 86400).declination * kDegreesOf;
    };
    EXPECT_NEAR(declination(secondsFromUtc(2020, 3, 20, 3, 50)), 0, 0.004);
    EXPECT_NEAR(declination(secondsFromUtc(2020, 9, 22, 13, 31)), 0, 0.004);
    EXPECT_NEAR(declination(secondsFromUtc(2020, 6, 20, 21, 44)), 23.4366, 0.002);
    EXPECT_NEAR(declination(secondsFromUtc(2020, 12, 21, 10, 2)), -23.4366, 0.002);
}

TEST(SunPosition, IsSmoothAndHighestInTheSouth) {
    const double latitude = 47 * kRadiansOf, longitude = 8.5 * kRadiansOf;
    const double start = secondsFromUtc(2024, 5, 3);
    double highest = -2, azimuth = 0;
    SunSeen before = sunSeenAt(start, latitude, longitude, std::nullopt);
    for (double t = 60; t <= 86400; t += 60) {
        const SunSeen sun = sunSeenAt(start + t, latitude, longitude, std::nullopt);
        EXPECT_LT(std::abs(sun.elevation - before.elevation), 0.26 * kRadiansOf) << t;
        EXPECT_LT(std::abs(std::remainder(sun.azimuth - before.azimuth, 2 * pi)), 0.6 * kRadiansOf) << t;
        if (sun.elevation > highest) {
            highest = sun.elevation;
            azimuth = sun.azimuth;
        }
        before = sun;
    }
    EXPECT_NEAR(azimuth * kDegreesOf, 180, 0.3);
    EXPECT_GE(sunSeenAt(start, latitude, longitude).azimuth, 0);
}

TEST(SunPosition, RefractionLiftsNearTheHorizonAlone) {
    const double latitude = 10 * kRadiansOf;
    const auto lift = [&](double seconds) {
        return (sunSeenAt(seconds, latitude, 0).elevation -
                sunSeenAt(seconds, latitude, 0, std::nullopt).elevation) *
               kDegreesOf;
    };
    const double midnight = secondsFromUtc(2024, 3, 20), rise = nextSunrise(midnight, latitude, 0).value();
    EXPECT_NEAR(lift(rise + 200), 0.48, 0.08);  // half a degree at the horizon
    EXPECT_NEAR(lift(secondsFromUtc(2024, 3, 20, 12)), 0.0025, 0.003);
    EXPECT_EQ(lift(midnight), 0);
    EXPECT_EQ(sunSeenAt(rise, latitude, 0, AirNow{0, 10}).elevation,
              sunSeenAt(rise, latitude, 0, std::nullopt).elevation);
}

// Refraction is that of 1010 hPa and 10 degrees, times P / 1010 and 283 / (273 + T) (Meeus, chapter 16).
TEST(SunPosition, RefractionGoesByPressureAndTemperatureOfTheAir) {
    const double latitude = 10 * kRadiansOf, midnight = secondsFromUtc(2024, 3, 20),
                 time = nextSunrise(midnight, latitude, 0).value() + 400;
    const double still = sunSeenAt(time, latitude, 0, std::nullopt).elevation;
    const auto lift = [&](const AirNow& air) { return sunSeenAt(time, latitude, 0, air).elevation - still; };
    // Saemundsson's formula: 1.02 / tan(h + 10.3 / (h + 5.11)) minutes of arc, h in degrees.
    const double degrees = still * kDegreesOf,
                 usual = 1.02 / std::tan((degrees + 10.3 / (degrees + 5.11)) * kRadiansOf) / 60 * kRadiansOf;
    EXPECT_GT(usual, 0.2 * kRadiansOf);
    for (const AirNow& air : {AirNow{1010, 10}, AirNow{1010, 40}, AirNow{1010, -40}, AirNow{505, 10},
                              AirNow{820, -25}, AirNow{300, 35}})
        EXPECT_NEAR(lift(air), usual * air.pressure_hPa / 1010 * 283 / (273 + air.temperature_C),
                    1e-6 * kRadiansOf)
            << air.pressure_hPa << " " << air.temperature_C;
}

TEST(SunPosition, PolarDaysAndNightsHaveNoSunrise) {
    const double june = secondsFromUtc(2024, 6, 21), december = secondsFromUtc(2024, 12, 21);
    const double tromso = 69.65 * kRadiansOf, east = 18.96 * kRadiansOf;
    EXPECT_FALSE(nextSunset(june, tromso, east));
    EXPECT_FALSE(nextSunrise(december, tromso, east));
    EXPECT_GT(sunSeenAt(june, tromso, east).elevation, 0);
    for (const double pole : {pi / 2, -pi / 2}) {
        const SunSeen sun = sunSeenAt(june, pole, 0, std::nullopt);
        EXPECT_NEAR(std::abs(sun.elevation) * kDegreesOf, 23.436, 0.01);
        EXPECT_GT(sun.elevation * pole, 0);
    }
}

TEST(SunPosition, SunriseAndSunsetAreWhereTheDiscTouchesTheHorizon) {
    for (const double latitude : {-60.0, -33.0, 0.0, 20.0, 50.0, 65.0})
        for (const double longitude : {-170.0, 0.0, 30.0, 180.0}) {
            const double from = secondsFromUtc(2025, 2, 11, 5);
            const double rise = nextSunrise(from, latitude * kRadiansOf, longitude * kRadiansOf).value();
            EXPECT_GE(rise, from);
            EXPECT_LE(rise, from + 86400 + 240);
            const auto height = [&](double t) {
                return sunSeenAt(t, latitude * kRadiansOf, longitude * kRadiansOf, std::nullopt).elevation *
                       kDegreesOf;
            };
            EXPECT_NEAR(height(rise), -0.8333, 0.003);
            EXPECT_GT(height(rise + 60), height(rise));
            const double set = nextSunset(from, latitude * kRadiansOf, longitude * kRadiansOf).value();
            EXPECT_NEAR(height(set), -0.8333, 0.003);
            EXPECT_LT(height(set + 60), height(set));
        }
}

TEST(SunPosition, DatesAreOfTheCalendar) {
    EXPECT_EQ(secondsFromUtc(1970, 1, 1), 0);
    EXPECT_EQ(secondsFromUtc(2000, 2, 29, 12, 30, 1.5), 951827401.5);
    EXPECT_EQ(secondsFromUtc(1969, 12, 31, 23, 59, 59), -1);
    EXPECT_THAT(test::errorOf([] { secondsFromUtc(2023, 2, 29); }),
                testing::HasSubstr("a day of the calendar"));
    for (const auto& call : {+[] { secondsFromUtc(2024, 0, 1); }, +[] { secondsFromUtc(2024, 13, 1); },
                             +[] { secondsFromUtc(2024, 6, 31); }, +[] { secondsFromUtc(0, 1, 1); },
                             +[] { secondsFromUtc(10000, 1, 1); }, +[] { secondsFromUtc(2024, 1, 1, 24); },
                             +[] { secondsFromUtc(2024, 1, 1, 0, -1); },
                             +[] { secondsFromUtc(2024, 1, 1, 0, 0, std::nan("")); }})
        EXPECT_THROW(call(), Error);
}

TEST(SunPosition, RefusesWhatIsNoPlaceOrTime) {
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), inf, -inf, 1e300}) {
        EXPECT_THROW(sunSeenAt(bad, 0, 0), Error);
        EXPECT_THROW(sunSeenAt(0, bad, 0), Error);
        EXPECT_THROW(sunSeenAt(0, 0, bad), Error);
        EXPECT_THROW(nextSunrise(0, bad, 0), Error);
        EXPECT_THROW(sunSeenAt(0, 0, 0, AirNow{bad, 10}), Error);
    }
    EXPECT_THROW(sunSeenAt(0, 1.6, 0), Error);
    const SunSeen far = sunSeenAt(3e11, 0.5, 1);
    EXPECT_TRUE(std::isfinite(far.azimuth + far.elevation));
}

}  // namespace
}  // namespace stereonav
