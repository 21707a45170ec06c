// Where the sun stands at a date, a time and a place on the Earth, as a person sets them and as --sun takes
// it.
#pragma once

#include <optional>
#include <string>

#include "engine/scene/capabilities.h"

namespace stereonav {

// By the local clock. What is out of range or no number is brought into it by tidy().
struct SunClock {
    int year = 2000;    // 1 to 9999
    int day = 1;        // of the year, from 1
    double hour = 12;   // from 0 to below 24
    double offset = 0;  // hours that the clock is ahead of UTC, -12 to 14
    PlaceOnEarth place;
    bool operator==(const SunClock& other) const;
};
SunClock tidy(SunClock clock);
int daysIn(int year);

// "2024-06-21", "13:30"; the other way none where it is none.
std::string dateText(const SunClock& clock);
std::string timeText(double hour);
std::optional<SunClock> withDate(SunClock clock, const std::string& date);
std::optional<SunClock> withTime(SunClock clock, const std::string& time);
// Of now, by a clock that goes with the longitude. seconds: since 1970, UTC.
SunClock clockAt(double seconds, const PlaceOnEarth& place);

// Since 1970, UTC.
double secondsOf(const SunClock& clock);

struct SunThen {
    SunPlace world;          // as --sun has it: from the world's north
    double trueAzimuth = 0;  // radians, from the Earth's north
    bool below = false;      // the horizon
    // In the 24 hours from the clock's midnight, hours by it; none: it stays up, or down.
    std::optional<double> rises, sets;
    bool staysUp = false;  // all that day; else, where it neither rises nor sets, down
};
// north: where the Earth's north is, radians clockwise from the world's (OnEarth::northAt).
SunThen sunThen(const SunClock& clock, double north);

// What --sun takes, to a thousandth of a degree.
std::string sunOptionText(const SunPlace& sun);
// "azimuth 182.3, elevation 66.0 degrees"; whether that is below the horizon; sunrise and sunset: a line
// each.
std::string describe(const SunThen& sun);

}  // namespace stereonav
