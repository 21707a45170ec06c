// The table of options as a page: docs/options.md.
#pragma once

#include <string>

namespace stereonav {

// Returns the page as Markdown, with lines of at most 120 characters.
std::string optionPage();

}  // namespace stereonav
