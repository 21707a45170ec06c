// The sun's position at a time and a place on the Earth. Meeus, Astronomical Algorithms, 2nd edition,
// chapters 12 (sidereal time), 13 (horizon), 16 (refraction), 25 (the sun, lower accuracy) and 40 (parallax).
// From 1950 to 2050 within 0.02 degrees of an almanac, except for refraction, which varies by more than this
// within a degree of the horizon. Differs from Meeus: the difference of the clocks, TD - UT, is taken to be
// 64 s throughout, which causes an error of 0.0004 degrees in that period.
#pragma once

#include <optional>

namespace stereonav {

// Returns seconds since 1970 in UTC, without leap seconds, as clocks count them. Gregorian. Throws Error for
// invalid dates (31 June), for hours from 24, and for years outside 1..9999.
double secondsFromUtc(int year, int month, int day, int hour = 0, int minute = 0, double second = 0);

// The sun's place in radians: right ascension from 0 to 2 pi, declination; apparent, of date, seen from the
// Earth's middle.
struct SunOnSphere {
    double rightAscension = 0, declination = 0;
};
// Returns the sun's place at a day of dynamical time (TD).
SunOnSphere sunOnSphere(double julianDay);

// State of the air that bends light: 0 to 2000 hPa, -200 to 200 degrees Celsius.
struct AirNow {
    double pressure_hPa = 1010, temperature_C = 10;
};

// Where the sun is seen from the ground, radians: azimuth clockwise from true north, 0 to 2 pi; elevation of
// the disc's middle.
struct SunSeen {
    double azimuth = 0, elevation = 0;
};
// Returns where the sun is seen. seconds: as secondsFromUtc() counts them. latitude: radians, north, -pi/2 to
// pi/2. longitude: radians, east. air: none leaves refraction out; with it the sun is lifted as long as it is
// above -1 degree. Throws Error for numbers that are not finite or out of range.
SunSeen sunSeenAt(double seconds, double latitude, double longitude,
                  const std::optional<AirNow>& air = AirNow());

// Returns the next moment at which the disc's upper edge touches a level horizon, in usual air (0.8333
// degrees), within a day: seconds as above, to half a second; none where the sun stays up or down. A day or a
// night of less than four minutes, which polar summers begin with, may be passed over.
std::optional<double> nextSunrise(double seconds, double latitude, double longitude);
std::optional<double> nextSunset(double seconds, double latitude, double longitude);

}  // namespace stereonav
