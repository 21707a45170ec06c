#include "terrain/read/gdal/height_unit.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace stereonav {
namespace {

constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937, kBritishFoot = 0.3047994715386762;

struct Named {
    std::string_view name;  // words with one space between them
    double metres;
};

// UCUM's names are among them, without their brackets: [ft_i], [ft_us].
constexpr Named kUnits[] = {{"m", 1},
                            {"mtr", 1},
                            {"mtrs", 1},
                            {"metre", 1},
                            {"meter", 1},
                            {"metres", 1},
                            {"meters", 1},
                            {"ft", kFoot},
                            {"foot", kFoot},
                            {"feet", kFoot},
                            {"ft i", kFoot},
                            {"ft int", kFoot},
                            {"ft intl", kFoot},
                            {"ftintl", kFoot},
                            {"ift", kFoot},
                            {"international foot", kFoot},
                            {"international feet", kFoot},
                            {"intl foot", kFoot},
                            {"intl feet", kFoot},
                            {"foot international", kFoot},
                            {"feet international", kFoot},
                            {"us ft", kSurveyFoot},
                            {"ft us", kSurveyFoot},
                            {"usft", kSurveyFoot},
                            {"ftus", kSurveyFoot},
                            {"sft", kSurveyFoot},
                            {"us foot", kSurveyFoot},
                            {"us feet", kSurveyFoot},
                            {"foot us", kSurveyFoot},
                            {"feet us", kSurveyFoot},
                            {"survey foot", kSurveyFoot},
                            {"survey feet", kSurveyFoot},
                            {"us survey foot", kSurveyFoot},
                            {"us survey feet", kSurveyFoot},
                            {"foot us survey", kSurveyFoot},
                            {"feet us survey", kSurveyFoot},
                            {"ft br", kBritishFoot},
                            {"in", kFoot / 12},
                            {"inch", kFoot / 12},
                            {"inches", kFoot / 12},
                            {"in i", kFoot / 12},
                            {"yd", 3 * kFoot},
                            {"yard", 3 * kFoot},
                            {"yards", 3 * kFoot},
                            {"yd i", 3 * kFoot},
                            {"fathom", 6 * kFoot},
                            {"fathoms", 6 * kFoot},
                            {"fth i", 6 * kFoot},
                            {"dm", 0.1},
                            {"decimetre", 0.1},
                            {"decimeter", 0.1},
                            {"decimetres", 0.1},
                            {"decimeters", 0.1},
                            {"cm", 0.01},
                            {"centimetre", 0.01},
                            {"centimeter", 0.01},
                            {"centimetres", 0.01},
                            {"centimeters", 0.01},
                            {"mm", 0.001},
                            {"millimetre", 0.001},
                            {"millimeter", 0.001},
                            {"millimetres", 0.001},
                            {"millimeters", 0.001},
                            {"km", 1000},
                            {"kilometre", 1000},
                            {"kilometer", 1000},
                            {"kilometres", 1000},
                            {"kilometers", 1000}};

// Words that say what heights are counted from.
constexpr std::string_view kLevels[] = {
    "above",      "below",        "over",       "under",    "mean",        "sea",         "level",
    "the",        "msl",          "amsl",       "asl",      "bmsl",        "bsl",         "agl",
    "ground",     "positive",     "up",         "down",     "datum",       "geoid",       "ellipsoid",
    "of",         "to",           "relative",   "vertical", "orthometric", "ellipsoidal", "height",
    "heights",    "elevation",    "elevations", "altitude", "depth",       "depths",      "reference",
    "referenced", "surface",      "local",      "tide",     "water",       "high",        "low",
    "lowest",     "astronomical", "chart",      "wgs",      "egm",         "navd",        "ngvd",
    "in",         "and"};

char lowerCase(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool isDigit(std::string_view text, std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

// A word with two capitals and more, figures after them: NAVD88, MLLW, EVRF2007, NN.
bool isDatumCode(std::string_view word) {
    const auto isUpper = [](unsigned char c) { return std::isupper(c) != 0; };
    return std::isupper(static_cast<unsigned char>(word.front())) &&
           std::count_if(word.begin(), word.end(), isUpper) >= 2;
}

bool isFigure(std::string_view word) {
    return word.size() <= 4 &&
           std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Returns the words of a text without brackets, dots and underscores. Returns nothing where a sign or a power
// makes it another kind of unit.
std::optional<std::vector<std::string>> wordsOf(std::string_view text) {
    std::vector<std::string> words(1);
    for (std::size_t n = 0; n < text.size(); ++n) {
        const char c = text[n];
        if (std::string_view("/^*%").find(c) != std::string_view::npos) return std::nullopt;
        if (text.substr(n, 3) == "(s)") {  // "meter(s)"
            n += 2;
            continue;
        }
        if (c == '-' && isDigit(text, n + 1) && !isDigit(text, n + 2)) return std::nullopt;  // "m s-1"
        if (c == '.') continue;  // "a.s.l.", "U.S."
        if (std::string_view(" \t_-+,;:()[]").find(c) != std::string_view::npos)
            words.emplace_back();
        else
            words.back() += c;
    }
    std::erase(words, "");
    return words;
}

// The longest name that the words begin with; how many words that are.
std::pair<const Named*, std::size_t> unitAtFront(const std::vector<std::string>& words) {
    std::pair<const Named*, std::size_t> found{nullptr, 0};
    std::string front;
    for (std::size_t count = 1; count <= std::min<std::size_t>(words.size(), 4); ++count) {
        if (count > 1) front += ' ';
        for (const char c : words[count - 1]) front += lowerCase(c);
        for (const Named& unit : kUnits)
            if (unit.name == front) found = {&unit, count};
    }
    return found;
}

}  // namespace

std::optional<HeightUnit> heightUnitOf(std::string_view text) {
    const auto words = wordsOf(text);
    if (!words) return std::nullopt;
    if (words->empty()) return HeightUnit{};
    HeightUnit unit;
    std::size_t next = 0;
    std::string first;
    for (const char c : words->front()) first += lowerCase(c);
    // "masl" is a unit and a level in one word.
    if (first == "masl" || first == "mamsl" || first == "mmsl") {
        next = 1;
    } else {
        const auto [named, count] = unitAtFront(*words);
        if (!named) return std::nullopt;
        unit.metres = named->metres, next = count;
    }
    const std::size_t level = next;  // where its words begin: a figure comes after one of them
    for (; next < words->size(); ++next) {
        const std::string& word = (*words)[next];
        std::string lower;
        for (const char c : word) lower += lowerCase(c);
        const bool known = std::find(std::begin(kLevels), std::end(kLevels), lower) != std::end(kLevels) ||
                           lower.starts_with("geoid") || lower.starts_with("egm");
        if (!known && !isDatumCode(word) && (next == level || !isFigure(word))) return std::nullopt;
        unit.down |= lower == "below" || lower == "under" || lower == "bmsl" || lower == "bsl" ||
                     lower == "depth" || lower == "depths" || lower == "down";
    }
    return unit;
}

}  // namespace stereonav
