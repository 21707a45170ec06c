#include "app/view/search_hits.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace stereonav {
namespace {

constexpr std::size_t kShortestPart = 3;  // letters of a word that is found within others

// Returns the words of a text in small letters. Signs that are alone ("[") are words too.
std::vector<std::string> wordsOf(const std::string& text) {
    std::string spaced;
    for (const char letter : text) {
        const auto c = static_cast<unsigned char>(letter);
        const bool parts = c == ' ' || c == ',' || c == ':' || c == ';' || c == '(' || c == ')' || c == '/';
        spaced += parts ? ' ' : static_cast<char>(std::tolower(c));
    }
    std::vector<std::string> words;
    std::istringstream in(spaced);
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

int pointsOf(const std::vector<std::string>& text, const std::string& word) {
    int most = 0;
    for (const std::string& other : text) {
        if (other == word) return 4;
        if (other.starts_with(word))
            most = std::max(most, 2);
        else if (word.size() >= kShortestPart && other.find(word) != std::string::npos)
            most = std::max(most, 1);
    }
    return most;
}

// Returns points for how well the text answers; 0 where a word is missing.
int pointsOf(const std::string& text, const std::vector<std::string>& asked) {
    const std::vector<std::string> words = wordsOf(text);
    int sum = 1;
    for (const std::string& word : asked) {
        const int points = pointsOf(words, word);
        if (points == 0) return 0;
        sum += points;
    }
    return sum;
}

std::string textOf(const KeyHelp& key) {
    return key.meaning + " " + key.keys + " " + key.also;
}
std::string textOf(const Option& option) {
    std::string key = option.key;
    std::replace(key.begin(), key.end(), '-', ' ');
    return key + " " + option.key + " " + option.help + " " + option.also;
}
std::string textOf(const Command& command) {
    return std::string(command.name) + " " + command.help + " export command line";
}

// Whether it is a setting of what is shown, here or on the command line.
bool isSetting(const Option& option) {
    return (option.commands & command::kView) && !option.positional() &&
           option.key != std::string_view(kSetKey);
}

}  // namespace

std::vector<SearchHit> searchHits(const std::string& words) {
    const std::vector<std::string> asked = wordsOf(words);
    std::vector<std::pair<int, SearchHit>> found;
    const auto add = [&](const std::string& text, const SearchHit& hit) {
        if (const int points = pointsOf(text, asked)) found.emplace_back(points, hit);
    };
    for (const auto* entries : {&viewKeys(), &menuEntries()})
        for (const KeyHelp& key : *entries) add(textOf(key), {.key = &key});
    for (const Option& option : optionTable())
        if (isSetting(option) && !(asked.empty() && option.panel == OptionPanel::None))
            add(textOf(option), {.option = &option});
    if (!asked.empty())
        for (const Command& command : commands())
            if (command.command != command::kView) add(textOf(command), {.command = &command});
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<SearchHit> hits;
    for (const auto& [points, hit] : found) hits.push_back(hit);
    return hits;
}

}  // namespace stereonav
