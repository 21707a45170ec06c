// Dates and times as people write them on a command line.
#pragma once

#include <optional>
#include <string>

namespace stereonav {

// "2026-06-21T19:30", "2026-06-21T19:30:15" or "2026-06-21", which is its noon; a Z at the end changes
// nothing. Seconds since 1970 in UTC; none for anything else, or no day of the calendar.
std::optional<double> secondsFromText(const std::string& text);

}  // namespace stereonav
