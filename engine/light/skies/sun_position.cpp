#include "engine/light/skies/sun_position.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"

namespace stereonav {
namespace {

using std::numbers::pi;

constexpr double kDegreeOfArc = pi / 180;
constexpr double kDaySeconds = 86400, kUnixDay = 2440587.5;  // the Julian day of 1970
constexpr double kEpoch = 2451545.0, kCentury = 36525;       // J2000, days
constexpr double kClocks = 64;                               // TD - UT, seconds
constexpr double kSunParallax = 8.794 / 3600 * kDegreeOfArc;
constexpr double kRiseElevation = -0.8333 * kDegreeOfArc;  // half a disc, and 34 minutes of refraction
constexpr double kLook = 240;                              // seconds between two tests for a crossing
constexpr double kLatestTime = 3e11;                       // seconds: the year 11,000

double turnOf(double angle) {
    const double turns = std::fmod(angle, 2 * pi);
    return turns < 0 ? turns + 2 * pi : turns;
}

// Radians, mean, at Greenwich (Meeus, equation 12.4). julianDay: UT.
double siderealTime(double julianDay) {
    const double days = julianDay - kEpoch, t = days / kCentury;
    const double degrees = 280.46061837 + 360.98564736629 * days + t * t * (0.000387933 - t / 38710000);
    return turnOf(std::fmod(degrees, 360) * kDegreeOfArc);
}

// Returns the longitude of the ascending node of the moon's orbit, on which nutation depends; radians. t:
// centuries since J2000.
double nodeAt(double t) {
    return std::fmod(125.04 - 1934.136 * t, 360) * kDegreeOfArc;
}

double obliquityAt(double t) {
    const double mean = 23.439291111 - t * (0.013004167 + t * (1.639e-7 - t * 5.0361e-7));
    return (mean + 0.00256 * std::cos(nodeAt(t))) * kDegreeOfArc;
}

void checkPlaceAndTime(double seconds, double latitude, double longitude) {
    const auto check = [](const char* what, double value, double most, const char* unit) {
        if (!(std::abs(value) <= most))
            throw Error("", what, fmt::format("expected at most {:g} {}, got {:g}", most, unit, value),
                        "give another one");
    };
    check("time", seconds, kLatestTime, "s from 1970");
    check("latitude", latitude, pi / 2 * (1 + 1e-12), "radians");
    check("longitude", longitude, 4 * pi, "radians");
}

// Returns where the sun stands without refraction.
SunSeen sunInVacuum(double seconds, double latitude, double longitude) {
    const double day = kUnixDay + seconds / kDaySeconds, dynamical = day + kClocks / kDaySeconds;
    const SunOnSphere sun = sunOnSphere(dynamical);
    const double t = (dynamical - kEpoch) / kCentury;
    // Nutation in longitude turns the sphere too (equation of the equinoxes).
    const double nutation = -17.2 / 3600 * kDegreeOfArc * std::sin(nodeAt(t)) * std::cos(obliquityAt(t));
    const double hour = siderealTime(day) + nutation + longitude - sun.rightAscension;
    const double sinLat = std::sin(latitude), cosLat = std::cos(latitude), sinDec = std::sin(sun.declination),
                 cosDec = std::cos(sun.declination);
    const double up = sinLat * sinDec + cosLat * cosDec * std::cos(hour),
                 north = cosLat * sinDec - sinLat * cosDec * std::cos(hour), east = -cosDec * std::sin(hour);
    const double elevation = std::atan2(up, std::hypot(north, east));
    return {turnOf(std::atan2(east, north)), elevation - kSunParallax * std::cos(elevation)};
}

// Radians (Saemundsson; Meeus, equation 16.4).
double refraction(double elevation, const AirNow& air) {
    const double degrees = elevation / kDegreeOfArc;
    if (degrees < -1) return 0;
    const double minutes = 1.02 / std::tan((degrees + 10.3 / (degrees + 5.11)) * kDegreeOfArc);
    return std::max(
        0.0, minutes / 60 * kDegreeOfArc * (air.pressure_hPa / 1010) * (283 / (273 + air.temperature_C)));
}

// sign: 1 for a rise, -1 for a fall through the horizon.
std::optional<double> nextCrossing(double seconds, double latitude, double longitude, double sign) {
    checkPlaceAndTime(seconds, latitude, longitude);
    const auto above = [&](double time) {
        return sign * (sunInVacuum(time, latitude, longitude).elevation - kRiseElevation) > 0;
    };
    bool before = above(seconds);
    for (double time = seconds; time < seconds + kDaySeconds; time += kLook) {
        const bool after = above(time + kLook);
        if (!before && after) {
            double low = time, high = time + kLook;
            while (high - low > 0.5) (above(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
            return high;
        }
        before = after;
    }
    return std::nullopt;
}

}  // namespace

double secondsFromUtc(int year, int month, int day, int hour, int minute, double second) {
    namespace chrono = std::chrono;
    const auto fail = [&](const char* expected) {
        throw Error("", "date",
                    fmt::format("expected {}, got {}-{}-{} {}:{}:{:g}", expected, year, month, day, hour,
                                minute, second),
                    "give year, month, day and UTC");
    };
    if (year < 1 || year > 9999) fail("a year from 1 to 9999");
    const bool positive = month >= 1 && month <= 12 && day >= 1 && day <= 31;
    const chrono::year_month_day date(chrono::year(year),
                                      chrono::month(static_cast<unsigned>(positive ? month : 1)),
                                      chrono::day(static_cast<unsigned>(positive ? day : 1)));
    if (!positive || !date.ok()) fail("a day of the calendar");
    if (hour < 0 || hour > 23 || minute < 0 || minute > 59 || !(second >= 0 && second < 61))
        fail("a time of the day");
    const auto days = chrono::sys_days(date).time_since_epoch().count();
    return kDaySeconds * static_cast<double>(days) + 3600.0 * hour + 60.0 * minute + second;
}

SunOnSphere sunOnSphere(double julianDay) {
    const double t = (julianDay - kEpoch) / kCentury;
    const double meanLongitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
    const double anomaly = std::fmod(357.52911 + t * (35999.05029 - t * 0.0001537), 360) * kDegreeOfArc;
    const double center = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                          (0.019993 - t * 0.000101) * std::sin(2 * anomaly) +
                          0.000289 * std::sin(3 * anomaly);
    const double apparent =
        std::fmod(meanLongitude + center - 0.00569 - 0.00478 * std::sin(nodeAt(t)), 360) * kDegreeOfArc;
    const double obliquity = obliquityAt(t);
    return {turnOf(std::atan2(std::cos(obliquity) * std::sin(apparent), std::cos(apparent))),
            std::asin(std::clamp(std::sin(obliquity) * std::sin(apparent), -1.0, 1.0))};
}

SunSeen sunSeenAt(double seconds, double latitude, double longitude, const std::optional<AirNow>& air) {
    checkPlaceAndTime(seconds, latitude, longitude);
    SunSeen sun = sunInVacuum(seconds, latitude, longitude);
    if (!air) return sun;
    if (!(air->pressure_hPa >= 0 && air->pressure_hPa <= 2000 && air->temperature_C > -200 &&
          air->temperature_C <= 200))
        throw Error("", "air", "expected 0 to 2000 hPa and -200 to 200 degrees Celsius, got others",
                    "leave it out for usual air");
    sun.elevation += refraction(sun.elevation, *air);
    return sun;
}

std::optional<double> nextSunrise(double seconds, double latitude, double longitude) {
    return nextCrossing(seconds, latitude, longitude, 1);
}

std::optional<double> nextSunset(double seconds, double latitude, double longitude) {
    return nextCrossing(seconds, latitude, longitude, -1);
}

}  // namespace stereonav
