// Text in tables of comma-separated values.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

// Returns a cell in quotes (RFC 4180), printable, with its line ends. Spreadsheets take text that begins with
// =, +, - or @ for a formula, which may start programs: an apostrophe is put before it, so that it stays
// text. Numbers are written without this function.
std::string csvText(std::string_view text);

}  // namespace stereonav
