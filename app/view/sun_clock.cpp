#include "app/view/sun_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

#include "engine/light/skies/sun_position.h"
#include "engine/text/number.h"

namespace stereonav {
namespace {

namespace chrono = std::chrono;

constexpr double kArcDegree = std::numbers::pi / 180, kHour = 3600, kDay = 86400;
constexpr int kFirstYear = 1, kLastYear = 9999;
constexpr double kLowestOffset = -12, kHighestOffset = 14;
constexpr double kLastMoment = 24 - 1e-6;  // hours

double within(double x, double low, double high, double otherwise) {
    return std::isfinite(x) ? std::clamp(x, low, high) : otherwise;
}

chrono::year_month_day dateOf(const SunClock& clock) {
    return chrono::sys_days(chrono::year(clock.year) / chrono::January / 1) + chrono::days(clock.day - 1);
}

double midnightOf(const SunClock& clock) {
    return secondsFromUtc(clock.year, 1, 1) + kDay * (clock.day - 1) - kHour * clock.offset;
}

// Reads whole numbers between marks from a whole text; empty where there are more or fewer.
template <std::size_t count>
std::optional<std::array<int, count>> wholesOf(std::string_view text, char between) {
    std::array<int, count> numbers{};
    for (std::size_t n = 0; n < count; ++n) {
        if (n > 0 && (text.empty() || text.front() != between)) return std::nullopt;
        if (n > 0) text.remove_prefix(1);
        const auto number = takeWhole<int>(text);
        if (!number || *number < 0) return std::nullopt;
        numbers[n] = *number;
    }
    return text.empty() ? std::optional(numbers) : std::nullopt;
}

}  // namespace

bool SunClock::operator==(const SunClock& other) const {
    return year == other.year && day == other.day && hour == other.hour && offset == other.offset &&
           place.latitude == other.place.latitude && place.longitude == other.place.longitude;
}

int daysIn(int year) {
    return chrono::year(year).is_leap() ? 366 : 365;
}

SunClock tidy(SunClock clock) {
    clock.year = std::clamp(clock.year, kFirstYear, kLastYear);
    clock.day = std::clamp(clock.day, 1, daysIn(clock.year));
    clock.hour = within(clock.hour, 0, kLastMoment, 12);
    clock.offset = within(clock.offset, kLowestOffset, kHighestOffset, 0);
    clock.place.latitude = within(clock.place.latitude, -90 * kArcDegree, 90 * kArcDegree, 0);
    clock.place.longitude = within(clock.place.longitude, -180 * kArcDegree, 180 * kArcDegree, 0);
    return clock;
}

std::string dateText(const SunClock& clock) {
    const chrono::year_month_day date = dateOf(clock);
    return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
}

std::string timeText(double hour) {
    const int minutes =
        std::clamp(static_cast<int>(std::floor(within(hour, 0, 24, 0) * 60 + 1e-6)), 0, 24 * 60 - 1);
    return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

std::optional<SunClock> withDate(SunClock clock, const std::string& date) {
    const auto numbers = wholesOf<3>(date, '-');
    if (!numbers) return std::nullopt;
    const auto [year, month, day] = *numbers;
    if (year < kFirstYear || year > kLastYear || month > 12 || day > 31) return std::nullopt;
    const chrono::year_month_day asked(chrono::year(year), chrono::month(static_cast<unsigned>(month)),
                                       chrono::day(static_cast<unsigned>(day)));
    if (!asked.ok()) return std::nullopt;
    clock.year = year;
    clock.day =
        static_cast<int>((chrono::sys_days(asked) - chrono::sys_days(chrono::year(year) / 1 / 1)).count()) +
        1;
    return clock;
}

std::optional<SunClock> withTime(SunClock clock, const std::string& time) {
    const auto numbers = wholesOf<2>(time, ':');
    if (!numbers || (*numbers)[0] > 23 || (*numbers)[1] > 59) return std::nullopt;
    clock.hour = (*numbers)[0] + (*numbers)[1] / 60.0;
    return clock;
}

SunClock clockAt(double seconds, const PlaceOnEarth& place) {
    SunClock clock;
    clock.place = place;
    clock.offset =
        std::round(within(place.longitude, -std::numbers::pi, std::numbers::pi, 0) / kArcDegree / 15);
    const double local = within(seconds, 0, 2e11, 0) + kHour * clock.offset;
    const double days = std::floor(local / kDay);
    const chrono::sys_days day{chrono::days(static_cast<int>(days))};
    clock.year = static_cast<int>(chrono::year_month_day(day).year());
    clock.day = static_cast<int>((day - chrono::sys_days(chrono::year(clock.year) / 1 / 1)).count()) + 1;
    clock.hour = std::floor((local - kDay * days) / 60) / 60;
    return tidy(clock);
}

double secondsOf(const SunClock& clock) {
    return midnightOf(clock) + kHour * clock.hour;
}

SunThen sunThen(const SunClock& asked, double north) {
    const SunClock clock = tidy(asked);
    const auto [latitude, longitude] = clock.place;
    const SunSeen seen = sunSeenAt(secondsOf(clock), latitude, longitude);
    SunThen sun;
    sun.trueAzimuth = seen.azimuth;
    sun.world = {std::remainder(seen.azimuth + within(north, -10, 10, 0), 2 * std::numbers::pi),
                 seen.elevation};
    sun.below = seen.elevation < 0;
    const double midnight = midnightOf(clock);
    const auto hours = [&](const std::optional<double>& moment) {
        return moment ? std::optional((*moment - midnight) / kHour) : std::nullopt;
    };
    sun.rises = hours(nextSunrise(midnight, latitude, longitude));
    sun.sets = hours(nextSunset(midnight, latitude, longitude));
    sun.staysUp = !sun.rises && !sun.sets && !sun.below;
    return sun;
}

std::string degreeText(double radians) {
    return fmt::format("{:.6g}", std::round(1000 * radians / kArcDegree) / 1000 + 0.0);
}

std::string sunOptionText(const SunPlace& sun) {
    return degreeText(sun.azimuth) + "," + degreeText(sun.elevation);
}

std::string describe(const SunThen& sun) {
    std::string text = fmt::format("azimuth {:.1f}, elevation {:.1f} degrees", sun.trueAzimuth / kArcDegree,
                                   sun.world.elevation / kArcDegree + 0.0);
    if (sun.below) text += "\nbelow the horizon";
    if (sun.rises && sun.sets)
        return text + fmt::format("\nsunrise {}, sunset {}", timeText(*sun.rises), timeText(*sun.sets));
    if (sun.rises) return text + fmt::format("\nsunrise {}, no sunset", timeText(*sun.rises));
    if (sun.sets) return text + fmt::format("\nsunset {}, no sunrise", timeText(*sun.sets));
    return text + (sun.staysUp ? "\nit does not set this day" : "\nit does not rise this day");
}

}  // namespace stereonav
