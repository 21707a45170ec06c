// The sun's place by date, time and place on the Earth, as the user sets them and as --sun takes it.
#pragma once

#include <optional>
#include <string>

#include "engine/scene/capabilities.h"

namespace stereonav {

// Date and time by the local clock. tidy() brings values into their ranges.
struct SunClock {
    int year = 2000;    // 1 to 9999
    int day = 1;        // day of the year, from 1
    double hour = 12;   // 0 to below 24
    double offset = 0;  // hours that the clock is ahead of UTC, -12 to 14
    PlaceOnEarth place;
    bool operator==(const SunClock& other) const;
};
SunClock tidy(SunClock clock);
int daysIn(int year);

// Return "2024-06-21" and "13:30"; the reverse functions return empty for invalid text.
std::string dateText(const SunClock& clock);
std::string timeText(double hour);
std::optional<SunClock> withDate(SunClock clock, const std::string& date);
std::optional<SunClock> withTime(SunClock clock, const std::string& time);
// Returns the present time by a clock of the place's longitude. seconds: since 1970, UTC.
SunClock clockAt(double seconds, const PlaceOnEarth& place);

// Returns seconds since 1970, UTC.
double secondsOf(const SunClock& clock);

struct SunThen {
    SunPlace world;          // in the form of --sun: from the world's north
    double trueAzimuth = 0;  // radians, from the Earth's north
    bool below = false;      // below the horizon
    // Hours by the clock in the 24 hours from its midnight; empty: it stays up, or down.
    std::optional<double> rises, sets;
    bool staysUp = false;  // all day; false without sunrise and sunset: it stays down
};
// north: direction of the Earth's north, radians clockwise from the world's (OnEarth::northAt).
SunThen sunThen(const SunClock& clock, double north);

// Returns an angle to a thousandth of a degree, which is not visible in a picture.
std::string degreeText(double radians);
// Returns a value of --sun.
std::string sunOptionText(const SunPlace& sun);
// Returns "azimuth 182.3, elevation 66.0 degrees", whether that is below the horizon, sunrise and sunset: a
// line each.
std::string describe(const SunThen& sun);

}  // namespace stereonav
