// Options of the instruments for ground.
#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/usual_words.h"
#include "app/options/utc_text.h"

namespace stereonav {
namespace {

using namespace command;

SurveyPlace surveyPlaceOf(const OptionValue& value) {
    SurveyPlace place;
    place.reference = {value.numbers[0], value.numbers[1]};
    if (value.numbers.size() > 2) place.height_m = value.numbers[2];
    return place;
}

// "x,y,x,y,...": two places or more.
std::optional<ValueProblem> problemOfPlaces(const std::string& text) {
    const std::vector<double> numbers = numbersFromText(text);
    if (numbers.size() >= 4 && numbers.size() % 2 == 0) return std::nullopt;
    return ValueProblem{"expected two places or more as x,y,x,y,..., got " + shownText(text),
                        "as in 394268,3798272,401000,3801500"};
}

std::optional<ValueProblem> problemOfCorners(const std::string& text) {
    const std::vector<double> numbers = numbersFromText(text);
    if (numbers.size() >= 6 && numbers.size() % 2 == 0) return std::nullopt;
    return ValueProblem{"expected three corners or more as x,y,x,y,..., got " + shownText(text),
                        "the last is joined to the first"};
}

std::vector<glm::dvec2> placesOf(const OptionValue& value) {
    const std::vector<double> numbers = numbersFromText(value.text);
    std::vector<glm::dvec2> places;
    for (std::size_t n = 0; n + 1 < numbers.size(); n += 2) places.emplace_back(numbers[n], numbers[n + 1]);
    return places;
}

SurveyLine& lineOf(OptionTargets& to) {
    return to.measure ? to.measure->line : to.profile->line;
}

std::optional<ValueProblem> problemOfTime(const std::string& text) {
    if (secondsFromText(text)) return std::nullopt;
    return ValueProblem{"expected a date and a time in UTC, got " + shownText(text),
                        "as in 2026-06-21T19:30"};
}

bool seesNoGround(const Asked& asked) {
    return !asked.has("out");
}

}  // namespace

std::vector<Option> surveyOptions() {
    return {
        {.key = "from",
         .value = numbersValue(groundPlaceNumbers()),
         .help = "the eye: x,y in the reference system of the elevation model's file, without one metres "
                 "east and "
                 "north of its middle",
         .commands = kViewshed,
         .required = true,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.viewshed->from = surveyPlaceOf(value); }},
        {.key = "to",
         .value = numbersValue(groundPlaceNumbers()),
         .help = "a second place: whether both see each other, and how far the line passes over the ground",
         .commands = kViewshed,
         .take = [](OptionTargets& to, const OptionValue& value) { to.viewshed->to = surveyPlaceOf(value); }},
        {.key = "target-height",
         .value = numberValue(within(0, 1e6, "metres")),
         .help = "of what is looked at, above the ground",
         .fallback = "0, the ground itself",
         .commands = kViewshed,
         .rules = {{seesNoGround, "has an effect on --out alone",
                    "leave it out; --to has a height of its own"}},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.viewshed->targetHeight_m = value.number(); }},
        {.key = "reach",
         .value = numberValue(above(0, 1e9, "metres")),
         .help = "how far one sees, over the plan",
         .fallback = "all of the ground",
         .commands = kViewshed,
         .rules = {{seesNoGround, "has an effect on --out alone", kLeaveItOut}},
         .take = [](OptionTargets& to, const OptionValue& value) { to.viewshed->reach_m = value.number(); }},
        {.key = "curvature",
         .value = flagValue(),
         .help = "the ground sinks as the Earth is round, or the body that it is of, less what air bends "
                 "light by",
         .commands = kViewshed,
         .take = [](OptionTargets& to, const OptionValue&) { to.viewshed->curvature = true; }},
        {.key = "refraction",
         .value = numberValue({0, 1, false, true}),
         .help = "share of the curvature that light follows",
         .advice = "0.13 is usual by day, 0 leaves it out",
         .fallback = "0.13, on other bodies than the Earth 0",
         .commands = kViewshed,
         .rules = {{[](const Asked& asked) { return !asked.has("curvature"); },
                    "has an effect with --curvature alone", "add it, or leave this out"}},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.viewshed->refraction = value.number(); }},
        {.key = "out",
         .value = fileValue(),
         .help = "a GeoTIFF over the ground's samples, .tif: 255 seen, 0 hidden, 128 no ground",
         .commands = kViewshed,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.out = value.text; }},
        {.key = "line",
         .value = textValue().checked(problemOfPlaces),
         .help = "x,y,x,y,...: the places of a line, as --from of viewshed has them",
         .commands = kMeasure | kProfile,
         .excludes = {{"track"}, {"path"}, {"area"}},
         .take = [](OptionTargets& to, const OptionValue& value) { lineOf(to).places = placesOf(value); }},
        {.key = "area",
         .value = textValue().checked(problemOfCorners),
         .help = "x,y,x,y,...: the corners of an area",
         .commands = kMeasure,
         .excludes = {{"track"}},
         .take = [](OptionTargets& to, const OptionValue& value) { to.measure->area = placesOf(value); }},
        {.key = "track",
         .value = fileValue(),
         .help = "a GPX or GeoJSON file with lines, and for measure areas",
         .commands = kMeasure | kProfile,
         .excludes = {{"path"}},
         .take = [](OptionTargets& to, const OptionValue& value) { lineOf(to).track = value.text; }},
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded flight (.gltf, .glb, .path): the ground under it",
         .commands = kProfile,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.path = value.text; }},
        {.key = "plane",
         .value = numberValue(within(-1e6, 1e6, "metres")),
         .help = "height of the level plane that volumes lie over and under",
         .fallback = "that of the lowest ground in the area",
         .commands = kMeasure,
         .take = [](OptionTargets& to, const OptionValue& value) { to.measure->plane_m = value.number(); }},
        {.key = "csv",
         .value = fileValue(),
         .help = "what was found as a table, .csv",
         .commands = kMeasure | kProfile,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 (to.measure ? to.measure->csv : to.profile->csv) = value.text;
             }},
        {.key = "geojson",
         .value = fileValue(),
         .help = "what was measured, with its figures, .geojson; --track reads it again",
         .commands = kMeasure,
         .take = [](OptionTargets& to, const OptionValue& value) { to.measure->geojson = value.text; }},
        {.key = "svg",
         .value = fileValue(),
         .help = "the profile as a chart, .svg",
         .commands = kProfile,
         .take = [](OptionTargets& to, const OptionValue& value) { to.profile->svg = value.text; }},
        {.key = "at",
         .value = textValue().checked(problemOfTime),
         .help = "date and time in UTC, 2026-06-21T19:30",
         .commands = kSun,
         .required = true,
         .take = [](OptionTargets& to, const OptionValue& value) { to.sun->at = value.text; }},
        {.key = "step",
         .value = numberValue(within(1, 60, "minutes")),
         .help = "between the places of the sun that hours are counted from",
         .fallback = "20",
         .commands = kSun,
         .rules = {{[](const Asked& asked) { return !asked.has("out") && !asked.has("picture"); },
                    "has an effect on --out and --picture alone", kLeaveItOut}},
         .take = [](OptionTargets& to, const OptionValue& value) { to.sun->step_min = value.number(); }},
        {.key = "out",
         .value = fileValue(),
         .help = "hours of sun on that day as a GeoTIFF over the ground's samples, .tif",
         .commands = kSun,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.out = value.text; }},
        {.key = "picture",
         .value = fileValue(),
         .help = "the same as a picture, from black to white, north up",
         .commands = kSun,
         .take = [](OptionTargets& to, const OptionValue& value) { to.sun->picture = value.text; }},
    };
}

}  // namespace stereonav
