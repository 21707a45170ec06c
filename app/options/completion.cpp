#include "app/options/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "app/options/command.h"
#include "app/options/pages.h"

namespace stereonav {
namespace {

std::vector<std::string> namesOfCommands() {
    std::vector<std::string> names;
    for (const Command& facts : commands()) names.emplace_back(facts.name);
    for (const PageFacts& page : pageFacts()) names.emplace_back(page.name);
    return names;
}

std::string optionsOf(CommandSet command) {
    std::string names = "--help";
    for (const Option& option : optionTable())
        if ((option.commands & command) && !option.positional()) names += " " + option.name();
    return names;
}

// Returns the words that an option takes, separated by blanks; "" for an option that takes none, and for
// --set.
std::string wordsBehind(const Option& option) {
    if (option.key == std::string_view("set")) return "";
    const ValueType& type = option.value;
    const std::string words = fmt::format("{}", fmt::join(type.words, " "));
    const std::string offered = fmt::format("{}", fmt::join(type.offered, " "));
    return words + (words.empty() || offered.empty() ? "" : " ") + offered;
}

// Returns a branch of the script's `case` statement: what may follow this option.
std::string caseOf(const Command& facts, const Option& option) {
    const std::string words = wordsBehind(option);
    const std::string offered = option.value.isFile() ? fmt::format("files=1 words=\"{}\"", words)
                                                      : fmt::format("words=\"{}\"", words);
    return fmt::format("        \"{} {}\") behind=1 {} ;;\n", facts.name, option.name(), offered);
}

}  // namespace

std::string bashCompletion() {
    const std::string names = fmt::format("{}", fmt::join(namesOfCommands(), " "));
    std::string options, behind, scenes;
    for (const Command& facts : commands()) {
        options += fmt::format("        {}) words=\"{}\" ;;\n", facts.name, optionsOf(facts.command));
        for (const Option& option : optionTable())
            if ((option.commands & facts.command) && option.positional())
                scenes += fmt::format("        {}) words=\"{}\" ;;\n", facts.name, wordsBehind(option));
            else if ((option.commands & facts.command) && option.value.kind != ValueKind::Flag)
                behind += caseOf(facts, option);
    }
    for (const PageFacts& page : pageFacts())
        behind += fmt::format("        \"{0} {0}\") behind=1 words=\"{1}\" ;;\n", page.name, page.of);
    return fmt::format(R"(# Completes the words of stereonav in bash: source <(stereonav completion bash)
_stereonav() {{
    local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD-1]}}"
    local command="" word="" words="" files="" behind=""
    COMPREPLY=()
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case " {0} " in *" $word "*) command="$word"; break ;; esac
    done
    if [[ -z $command ]]; then
        COMPREPLY=($(compgen -W "{0} --help --version" -- "$current"))
        return
    fi
    case "$command $previous" in
{2}    esac
    if [[ -z $behind ]]; then
        files=1
        if [[ $current == -* ]]; then
            files=""
            case "$command" in
{1}            esac
        else
            case "$command" in
{3}            esac
        fi
    fi
    COMPREPLY=($(compgen -W "$words" -- "$current"))
    [[ -z $files ]] || COMPREPLY+=($(compgen -f -- "$current" || true))
}}
complete -o filenames -F _stereonav stereonav
)",
                       names, options, behind, scenes);
}

}  // namespace stereonav
