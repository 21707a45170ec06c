// The version of the program, and what this build leaves out (CMake's STEREONAV_DISPLAY).
#pragma once

#include <string>

namespace stereonav {

const char* versionNumber();  // "0.2.0"
const char* versionDate();    // the day of that version, "2026-11-27"
// Returns "stereonav 0.2.0" and, where this build leaves something out, a second line that names it.
std::string versionText();

// Throws Error that says how to build the program with `part`, which `option` needs.
[[noreturn]] void throwBuiltWithout(const std::string& part, const std::string& option);

}  // namespace stereonav
