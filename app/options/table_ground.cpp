// Options: how ground is seen, what is drawn on it, and tracks that are flown.
#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/option_take.h"
#include "app/options/usual_words.h"

namespace stereonav {
using namespace command;
using namespace scene_type;

std::vector<Option> groundPaintOptions() {
    return {
        {.key = "contours",
         .value = numbersValue(contourNumbers()),
         .help = "height between contour lines on the ground; every fifth line is wider",
         .also = "isolines topographic relief lines layer",
         .fallback = "none",
         .commands = kRender | kPlay | kView,
         .scenes = kTerrain,
         .panel = OptionPanel::Material,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.scene->ground.contoursAuto = value.word == kAutoContours;
                 if (!value.numbers.empty()) to.scene->ground.contours_m = value.number();
             }},
        {.key = "curvature",
         .value = flagValue(),
         .help = "curve the ground as the Earth, or the body that it lies on, less the refraction of the "
                 "air: what is far away appears lower",
         .also = "earth round globe horizon bulge",
         .commands = kShowing | kReport,
         .scenes = kTerrain,
         .rules = {{[](const Asked& asked) { return asked.has("papers"); },
                    "does not go with --papers, which has scenes of its own", kLeaveItOut}},
         .panel = OptionPanel::View,
         .take = [](OptionTargets& to, const OptionValue&) { *to.curvature = true; }},
        {.key = "refraction",
         .value = numberValue({0, 1, false, true}),
         .help = "coefficient of refraction: the share of the curvature that light follows",
         .advice = "0.13 is usual by day, 0 leaves it out",
         .fallback = "0.13, on other bodies than the Earth 0",
         .commands = kShowing | kReport,
         .scenes = kTerrain,
         .rules = {{[](const Asked& asked) { return !asked.has("curvature"); }, "needs --curvature",
                    "add it, or leave this out"}},
         .panel = OptionPanel::View,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.refraction = value.number(); }},
        {.key = "tracks",
         .value = fileValue(),
         .help = "a GPX or GeoJSON file whose tracks, lines, borders and places are drawn on the ground",
         .also = "gpx geojson vector layer overlay route waypoints roads borders",
         .commands = kRender | kPlay | kView,
         .scenes = kTerrain,
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::ground, &GroundPaintOptions::tracks>},
        {.key = "follow",
         .value = fileValue(),
         .help = "a GPX or GeoJSON file with one track, which becomes the flight",
         .commands = kPlay | kView,
         .scenes = kTerrains,
         .excludes = {{"path"}},
         .inFile = false,
         .take = into<&SceneOptions::ground, &GroundPaintOptions::follow>},
        {.key = "follow-height",
         .value = numberValue(above(0, 1e6, "metres")),
         .help = "height of the flight of --follow above the ground",
         .advice = "50 is low over hills",
         .fallback = "50",
         .commands = kPlay | kView,
         .scenes = kTerrains,
         .rules = {{[](const Asked& asked) { return !asked.has("follow"); }, "needs --follow",
                    "add it, or leave this out"}},
         .inFile = false,
         .take = into<&SceneOptions::ground, &GroundPaintOptions::followHeight_m>},
    };
}

}  // namespace stereonav
