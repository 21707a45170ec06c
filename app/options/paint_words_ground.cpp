// Values of --paint for ground.
#include <algorithm>
#include <initializer_list>

#include "app/options/number_text.h"
#include "app/options/option_numbers.h"
#include "app/options/paint_words.h"
#include "app/options/utc_text.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

std::optional<ValueProblem> problemOfSeenFrom(const std::string& rest) {
    try {
        numbersIn("", groundPlaceNumbers(), rest);
        return std::nullopt;
    } catch (const Error&) {
        return ValueProblem{"viewshed expects a place as x,y,height after a colon, got " + shownText(rest),
                            "as in viewshed:394268,3798272,20; the height may be left out"};
    }
}

std::optional<ValueProblem> problemOfDay(const std::string& rest) {
    if (secondsFromText(rest)) return std::nullopt;
    return ValueProblem{"hours expects a date after a colon, got " + shownText(rest),
                        "as in hours:2026-12-21"};
}

bool paintsBy(const Asked& asked, std::initializer_list<const char*> words) {
    const std::string word = paintAskedOf(asked.given.text("paint")).word;
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::vector<OptionRule> groundPaintRules() {
    return {
        {[](const Asked& asked) {
             return asked.has("image") && paintsBy(asked, {"slope", "aspect", "hillshade", "natural",
                                                           "hypsometric", "swiss", "grey"});
         },
         "{paint} does not go with --image: both say what colour the ground has", "leave one of them out"},
        {[](const Asked& asked) { return asked.has("light") && paintsBy(asked, {"hillshade"}); },
         "hillshade does not go with --light: it is light itself", "leave one of them out"}};
}

std::vector<PaintWord> groundPaintWords() {
    using scene_type::kTerrain;
    return {{"slope", "", kTerrain},
            {"aspect", "", kTerrain},
            {"hillshade", "", kTerrain},
            {"natural", "", kTerrain},
            {"hypsometric", "", kTerrain},
            {"swiss", "", kTerrain},
            {"grey", "", kTerrain},
            {"viewshed", "X,Y,HEIGHT", kTerrain, problemOfSeenFrom},
            {"hours", "DATE", kTerrain, problemOfDay}};
}

}  // namespace stereonav
