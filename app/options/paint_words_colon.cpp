// Values of --paint for a colon's wall.
#include "app/options/number_text.h"
#include "app/options/paint_words.h"

namespace stereonav {
namespace {

std::optional<ValueProblem> problemOfFlight(const std::string& rest) {
    if (rest.empty() || rest == kPaintBothWays) return std::nullopt;
    for (const char* ending : {".gltf", ".glb", ".path"})
        if (rest.ends_with(ending)) return std::nullopt;
    return ValueProblem{"expected coverage, coverage:both or a recorded flight, got " +
                            shownText(std::string(kPaintCoverage) + ":" + rest),
                        "as in coverage:flight_0001.gltf"};
}

}  // namespace

std::vector<OptionRule> colonPaintRules() {
    return {{[](const Asked& asked) { return asked.has("isosurface"); },
             "does not go with --isosurface, which looks for no colon", "leave one of them out"},
            {[](const Asked& asked) {
                 return asked.shows(scene_type::kSurfaces) && (asked.has("transfer") || asked.has("opacity"));
             },
             "does not go with a translucent wall: what is painted lies on one surface",
             "leave one of them out"}};
}

std::vector<PaintWord> colonPaintWords() {
    using scene_type::kSurfaces;
    return {{kPaintCoverage, "[both or FLIGHT]", kSurfaces, problemOfFlight}};
}

}  // namespace stereonav
