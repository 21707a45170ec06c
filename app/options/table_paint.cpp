// The option --paint: one for all types of scenes, each of which has its own words (paint_words.h).
#include <algorithm>
#include <iterator>
#include <utility>

#include "app/options/number_text.h"
#include "app/options/option_table.h"
#include "app/options/option_take.h"
#include "app/options/paint_words.h"

namespace stereonav {
namespace {

using namespace command;

// Returns "slope, aspect, viewshed:X,Y,HEIGHT".
std::string namesOfPaint() {
    std::string names;
    for (const PaintWord& word : paintWords())
        names += (names.empty() ? "" : ", ") + std::string(word.word) + (*word.takes ? ":" : "") + word.takes;
    return names;
}

// Returns the words, with a colon where an argument has to follow.
std::vector<std::string> offeredPaint() {
    std::vector<std::string> offered;
    for (const PaintWord& word : paintWords())
        offered.push_back(std::string(word.word) + (*word.takes ? ":" : ""));
    return offered;
}

std::optional<PaintWord> paintWordNamed(const std::string& name) {
    for (const PaintWord& word : paintWords())
        if (name == word.word) return word;
    return std::nullopt;
}

std::optional<ValueProblem> problemOfPaint(const std::string& text) {
    const PaintAsked asked = paintAskedOf(text);
    const auto word = paintWordNamed(asked.word);
    const bool bare = asked.word == text;
    if (!word || (!word->problem && !bare))
        return ValueProblem{"expected one of " + namesOfPaint() + ", got " + shownText(text),
                            "leave it out for the usual colours"};
    return word->problem ? word->problem(asked.rest) : std::nullopt;
}

bool isOfAnotherScene(const Asked& asked) {
    const auto word = paintWordNamed(paintAskedOf(asked.given.text("paint")).word);
    return word && !asked.shows(word->scenes);
}

SceneSet scenesOfPaint() {
    SceneSet scenes = 0;
    for (const PaintWord& word : paintWords()) scenes |= word.scenes;
    return scenes;
}

}  // namespace

PaintAsked paintAskedOf(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) return {text, ""};
    return {text.substr(0, colon), text.substr(colon + 1)};
}

std::vector<PaintWord> paintWords() {
    std::vector<PaintWord> words = groundPaintWords();
    std::ranges::copy(colonPaintWords(), std::back_inserter(words));
    return words;
}

std::vector<Option> paintOptions() {
    std::vector<OptionRule> rules{
        {isOfAnotherScene, "{paint} is for scenes of another type", "leave it out"}};
    for (const auto& ofType : {groundPaintRules(), colonPaintRules()})
        rules.insert(rules.end(), ofType.begin(), ofType.end());
    return {
        {.key = "paint",
         .value = textValue().checked(problemOfPaint).offering(offeredPaint()),
         .help = "what surfaces are coloured by: " + namesOfPaint(),
         .also = "colormap palette ramp colors symbology style classification layer relief shaded exposure "
                 "vegetation water snow",
         .fallback = "their own colours",
         .commands = kRender | kPlay | kView,
         .scenes = scenesOfPaint(),
         .rules = std::move(rules),
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::paint>},
    };
}

}  // namespace stereonav
