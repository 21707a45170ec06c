#include "app/command/ground_line_options.h"

#include "app/options/number_text.h"
#include "app/options/option_take.h"

namespace stereonav {
namespace {

using command::kMeasure, command::kProfile;

// Returns what is wrong with "x,y,x,y,...": it needs two places or more.
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

}  // namespace

std::vector<Option> groundLineOptions() {
    return {
        {.key = "line",
         .value = textValue().checked(problemOfPlaces),
         .help = "x,y,x,y,...: the places of a line, in coordinates as for --from of viewshed",
         .commands = kMeasure | kProfile,
         .excludes = {{"track"}, {"path"}, {"area"}},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<GroundLineOptions>().line.places = placesOf(value); }},
        {.key = "area",
         .value = textValue().checked(problemOfCorners),
         .help = "x,y,x,y,...: the corners of an area, in the same coordinates",
         .commands = kMeasure,
         .excludes = {{"track"}},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<GroundLineOptions>().area = placesOf(value); }},
        {.key = "track",
         .value = fileValue(),
         .help = "a GPX or GeoJSON file with lines, and for measure areas",
         .commands = kMeasure | kProfile,
         .excludes = {{"path"}},
         .take = into<&GroundLineOptions::line, &SurveyLine::track>},
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded flight (.gltf, .glb, .path), under which the ground is taken",
         .commands = kProfile,
         .take = into<&GroundLineOptions::line, &SurveyLine::path>},
        {.key = "plane",
         .value = numberValue(within(-1e6, 1e6, "metres")),
         .help = "height of the level plane over and under which volumes are measured",
         .fallback = "the height of the lowest ground in the area",
         .commands = kMeasure,
         .take = into<&GroundLineOptions::plane_m>},
        {.key = "csv",
         .value = fileValue(),
         .help = "the results as a table, .csv",
         .commands = kMeasure | kProfile,
         .take = into<&GroundLineOptions::csv>},
        {.key = "geojson",
         .value = fileValue(),
         .help = "the lines and areas with their figures, .geojson; --track reads it again",
         .commands = kMeasure,
         .take = into<&GroundLineOptions::geojson>},
        {.key = "svg",
         .value = fileValue(),
         .help = "the profile as a chart, .svg",
         .commands = kProfile,
         .take = into<&GroundLineOptions::svg>},
    };
}

}  // namespace stereonav
