// Text in tables of comma-separated values.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

// Returns a cell in quotes (RFC 4180), printable, with its ends of lines. A spreadsheet takes what begins
// with =, +, - or @ for a formula, which may start programs: such text gets an apostrophe before it, so that
// it stays text. Numbers are written without this.
std::string csvText(std::string_view text);

}  // namespace stereonav
