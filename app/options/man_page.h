// The table of options as a man page of section 1: what `stereonav man` prints and what is installed.
#pragma once

#include <string>

namespace stereonav {

// Returns the page in roff, with the macros of man(7).
std::string manPage();

}  // namespace stereonav
