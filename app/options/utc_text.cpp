#include "app/options/utc_text.h"

#include <cstdio>

#include "engine/base/error.h"
#include "engine/light/skies/sun_position.h"

namespace stereonav {

std::optional<double> secondsFromText(const std::string& text) {
    int year = 0, month = 0, day = 0, hour = 12, minute = 0, second = 0;
    const std::string digits = text.ends_with('Z') ? text.substr(0, text.size() - 1) : text;
    const auto reads = [&](const char* pattern, int fields) {
        return std::sscanf(digits.c_str(), pattern, &year, &month, &day, &hour, &minute, &second) == fields;
    };
    // Trailing text and impossible dates are found by formatting the result again.
    char again[64];
    if (reads("%4d-%2d-%2dT%2d:%2d:%2d", 6))
        std::snprintf(again, sizeof again, "%04d-%02d-%02dT%02d:%02d:%02d", year, month, day, hour, minute,
                      second);
    else if (second = 0; reads("%4d-%2d-%2dT%2d:%2d", 5))
        std::snprintf(again, sizeof again, "%04d-%02d-%02dT%02d:%02d", year, month, day, hour, minute);
    else if (hour = 12, minute = 0; reads("%4d-%2d-%2d", 3))
        std::snprintf(again, sizeof again, "%04d-%02d-%02d", year, month, day);
    else
        return std::nullopt;
    if (digits != again) return std::nullopt;
    try {
        return secondsFromUtc(year, month, day, hour, minute, second);
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace stereonav
