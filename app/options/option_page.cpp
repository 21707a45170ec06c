#include "app/options/option_page.h"

#include <fmt/format.h>

#include "app/options/option_table.h"
#include "app/options/option_words.h"

namespace stereonav {
namespace {

constexpr std::size_t kWidth = 120;

std::string entryOf(const Option& option) {
    const std::string head = option.name() + (valueText(option).empty() ? "" : " " + valueText(option));
    return wrapped(fmt::format("- `{}`: {}", head, optionText(option, "`")), kWidth, "  ");
}

}  // namespace

std::string optionPage() {
    std::string page =
        "# Options\n\n"
        "Written by `stereonav options`; a test holds it against the program. Options stand after the "
        "command,\n"
        "or in a [scene file](formats.md#scenes) under `[options]`. Options that do not apply are an error, "
        "which\n"
        "names all of them in one line; `Refused` lists the reasons. A volume is a CT study or the built-in "
        "colon.\n";
    for (const std::string& group : optionGroups()) {
        page += fmt::format("\n## {}\n\n", group.empty() ? "Options" : group);
        for (const Option& option : optionTable())
            if (option.group == group) page += entryOf(option);
    }
    return page;
}

}  // namespace stereonav
