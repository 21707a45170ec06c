#include "app/options/option_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "app/options/option_table.h"

namespace stereonav {
namespace {

constexpr std::size_t kWidth = 120;

// Words of a list's entry, lines after the first indented.
std::string wrapped(const std::string& text) {
    std::string page, line;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t blank = std::min(text.find(' ', from), text.size());
        const std::string word = text.substr(from, blank - from);
        if (!line.empty() && line.size() + 1 + word.size() > kWidth) {
            page += line + "\n";
            line = " ";
        }
        line += (line.empty() ? "" : " ") + word;
        from = blank + 1;
    }
    return page + line + "\n";
}

std::string commandsText(CommandSet commands) {
    std::vector<std::string> names;
    for (const CommandFacts& facts : commandFacts())
        if (commands & facts.command) names.emplace_back(facts.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

// The types in the fewest words.
std::string scenesText(SceneSet scenes) {
    using namespace scene_type;
    struct Named {
        SceneSet scenes;
        const char* name;
    };
    constexpr Named kNames[]{{kAll, "all"},
                             {kTerrains | kVolumes, "terrains, volumes"},
                             {kCast, "all but media"},
                             {kNoMesh, "all but meshes"},
                             {kTerrains | kMeshFile, "terrains, meshes"},
                             {kMedia, "media"},
                             {kTerrains, "terrains"},
                             {kVolumes, "volumes"},
                             {kSurfaces, "volumes that are no media"},
                             {kStudies, "CT studies"},
                             {kTerrainMedium, "terrains as media"}};
    for (const Named& known : kNames)
        if (known.scenes == scenes) return known.name;
    return "some";
}

std::string valueText(const Option& option) {
    switch (option.value.kind) {
        case ValueKind::Flag:
            return "";
        case ValueKind::Word:
        case ValueKind::Text:
            return " WORD";
        case ValueKind::Words:
            return " WORD,...";
        case ValueKind::File:
            return " FILE";
        case ValueKind::FileOrWord:
            return " FILE";
        case ValueKind::Size:
            return " WIDTHxHEIGHT";
        case ValueKind::Numbers:
            return " NUMBERS";
        case ValueKind::Number:
        case ValueKind::Whole:
        case ValueKind::Fraction:
            break;
    }
    return " NUMBER";
}

// What stands for a value that is given has its name in capitals.
std::string withoutKeys(std::string text) {
    for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{'))
        text.replace(open, text.find('}', open) - open + 1, "VALUE");
    return text;
}

std::string entryOf(const Option& option) {
    std::string text = fmt::format("- `{}{}`: {}.", option.name(), valueText(option), helpLine(option));
    if (option.required) text += " Required.";
    text += fmt::format(" Commands: {}.", commandsText(option.commands));
    if (option.scenes != scene_type::kAll) text += fmt::format(" Scenes: {}.", scenesText(option.scenes));
    for (const Exclusion& other : option.excludes) text += fmt::format(" Not with `--{}`.", other.key);
    for (std::size_t n = 0; n < option.rules.size(); ++n)
        text += (n == 0 ? " Refused: " : "; ") + withoutKeys(option.rules[n].problem);
    if (!option.rules.empty()) text += ".";
    return wrapped(text);
}

}  // namespace

std::string optionPage() {
    std::string page =
        "# Options\n\n"
        "Written by `stereonav options`; a test holds it against the program. Options stand after the "
        "command,\n"
        "or in a [scene file](formats.md#scenes) under `[options]`. What does not apply is refused, all in "
        "one line.\n"
        "A volume is a CT study or the built-in colon. `Refused` says why an option is not taken beside "
        "others.\n";
    std::vector<std::string> groups;
    for (const Option& option : optionTable())
        if (std::find(groups.begin(), groups.end(), option.group) == groups.end())
            groups.emplace_back(option.group);
    for (const std::string& group : groups) {
        page += fmt::format("\n## {}\n\n", group.empty() ? "Options" : group);
        for (const Option& option : optionTable())
            if (option.group == group) page += entryOf(option);
    }
    return page;
}

}  // namespace stereonav
