#include "app/options/option_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/options/command.h"

namespace stereonav {
namespace {

std::string commandsText(CommandSet which) {
    std::vector<std::string> names;
    for (const Command& facts : commands())
        if (which & facts.command) names.emplace_back(facts.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

// Returns the types of scenes in as few words as possible.
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
                             {kSurfaces, "volumes that are not media"},
                             {kStudies, "CT studies"},
                             {kTerrain, "terrains that are not media"},
                             {kTerrain | kSurfaces, "terrains and volumes that are not media"},
                             {kTerrainMedium, "terrains as media"}};
    for (const Named& known : kNames)
        if (known.scenes == scenes) return known.name;
    return "some";
}

// Replaces placeholders of values, such as {model}, by VALUE.
std::string withoutKeys(std::string text) {
    for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{'))
        text.replace(open, text.find('}', open) - open + 1, "VALUE");
    return text;
}

}  // namespace

std::vector<std::string> optionGroups() {
    std::vector<std::string> groups;
    for (const Option& option : optionTable())
        if (std::find(groups.begin(), groups.end(), option.group) == groups.end())
            groups.emplace_back(option.group);
    return groups;
}

std::string valueText(const Option& option) {
    switch (option.value.kind) {
        case ValueKind::Flag:
            return "";
        case ValueKind::Word:
        case ValueKind::Text:
            return "WORD";
        case ValueKind::Words:
            return "WORD,...";
        case ValueKind::File:
        case ValueKind::FileOrWord:
            return "FILE";
        case ValueKind::Size:
            return "WIDTHxHEIGHT";
        case ValueKind::Numbers:
            return "NUMBERS";
        case ValueKind::Number:
        case ValueKind::Whole:
        case ValueKind::WholeOrPart:
        case ValueKind::Fraction:
            break;
    }
    return "NUMBER";
}

std::string optionText(const Option& option, const std::string& mark) {
    std::string text = helpLine(option) + ".";
    if (option.required) text += " Required.";
    text += fmt::format(" Commands: {}.", commandsText(option.commands));
    if (option.scenes != scene_type::kAll) text += fmt::format(" Scenes: {}.", scenesText(option.scenes));
    for (const Exclusion& other : option.excludes)
        text += fmt::format(" Not with {1}--{0}{1}.", other.key, mark);
    for (std::size_t n = 0; n < option.rules.size(); ++n)
        text += (n == 0 ? " Refused: " : "; ") + withoutKeys(option.rules[n].problem);
    if (!option.rules.empty()) text += ".";
    return text;
}

std::string wrapped(const std::string& text, std::size_t width, const std::string& indent) {
    std::string page, line;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t blank = std::min(text.find(' ', from), text.size());
        const std::string word = text.substr(from, blank - from);
        if (!line.empty() && line.size() + 1 + word.size() > width) {
            page += line + "\n";
            line = indent + word;
        } else {
            line += (line.empty() ? "" : " ") + word;
        }
        from = blank + 1;
    }
    return page + line + "\n";
}

}  // namespace stereonav
