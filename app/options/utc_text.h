// Dates and times on the command line.
#pragma once

#include <optional>
#include <string>

namespace stereonav {

// Returns seconds since 1970 in UTC for "2026-06-21T19:30", "2026-06-21T19:30:15" or "2026-06-21", which
// means noon; a Z at the end changes nothing. Returns "" for any other text, and for a day that is not in the
// calendar.
std::optional<double> secondsFromText(const std::string& text);

}  // namespace stereonav
