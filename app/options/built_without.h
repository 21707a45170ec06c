// The version of the program, and what this build leaves out (CMake's STEREONAV_DISPLAY).
#pragma once

#include <string>

namespace stereonav {

const char* versionNumber();  // "0.2.0"
const char* versionDate();    // the day of that version, "2026-11-27"
// "stereonav 0.2.0", and on a second line what it was built without, where that is anything.
std::string versionText();

// For the commands and scenes that need `part`: throws Error that says how to build it.
[[noreturn]] void throwBuiltWithout(const std::string& part, const std::string& option);

}  // namespace stereonav
