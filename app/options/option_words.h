// Descriptions of options for docs/options.md and the man page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/options/option_table.h"

namespace stereonav {

// Returns the headings of the table in its order; "": options of every scene.
std::vector<std::string> optionGroups();

// Returns the placeholder of an option's value: "NUMBER"; "" for flags.
std::string valueText(const Option& option);
// Returns sentences: help with range, unit and default, commands and scenes, and conflicting options. `mark`
// is put around names of other options.
std::string optionText(const Option& option, const std::string& mark);

// Returns lines of at most `width` characters where words allow it; lines after the first begin with
// `indent`.
std::string wrapped(const std::string& text, std::size_t width, const std::string& indent);

}  // namespace stereonav
