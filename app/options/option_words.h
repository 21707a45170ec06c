// What the pages (docs/options.md, the man page) say of an option, in words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/options/option_table.h"

namespace stereonav {

// Under which the table lists options, in its order; "": those of every scene.
std::vector<std::string> optionGroups();

// What stands behind its name: "NUMBER"; "" behind flags.
std::string valueText(const Option& option);
// Help with range, unit and default, its commands and scenes, what it does not go with: sentences. mark
// stands around names of other options.
std::string optionText(const Option& option, const std::string& mark);

// Lines of at most `width` characters where words allow it; those after the first begin with indent.
std::string wrapped(const std::string& text, std::size_t width, const std::string& indent);

}  // namespace stereonav
