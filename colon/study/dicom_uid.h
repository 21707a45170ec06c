// Unique identifiers of what the program makes (PS3.5 B.2): "2.25." and a UUID as a decimal number.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

// Returns the same UID for the same text, and another one for another: the UUID (version 8) is a hash of it.
std::string uidOfText(std::string_view text);

}  // namespace stereonav
