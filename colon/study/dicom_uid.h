// Unique identifiers of what the program makes (PS3.5 B.2): "2.25." and a UUID as a decimal number.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

// The same for the same text, and of another one another: the UUID (version 8) is a hash of it.
std::string uidOfText(std::string_view text);

}  // namespace stereonav
