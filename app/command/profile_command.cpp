// `stereonav profile`: heights along a line, a track or a flight, as a table and a chart.
#include <fmt/format.h>

#include <cmath>

#include "app/command/ground_line_options.h"
#include "app/options/output_place.h"
#include "app/output/command_result.h"
#include "app/output/profile_chart.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

void checkProfileOptions(const GroundLineOptions& options) {
    const SurveyLine& line = options.line;
    if (line.places.empty() && line.track.empty() && line.path.empty())
        throw Error("--line", "", "is required, or --track, or --path", "say where the profile goes");
    for (const NamedPlace& output : {NamedPlace{"--csv", options.csv}, NamedPlace{"--svg", options.svg}}) {
        if (output.place.empty()) continue;
        checkNoInput(output, inputsOf(options.scene));
        checkNoInput(output, inputsOf(line));
        checkOutputFile(output.option, output.place);
    }
}

// Returns an empty cell where a height is not known.
std::string heightCell(double height) {
    return std::isfinite(height) ? fmt::format("{:.3f}", height) : "";
}

std::string tableOf(const SurveyGround& survey, const std::vector<LinePoint>& points) {
    std::string text = "distance_m,along_m,x,y,height_m\n";
    for (const LinePoint& point : points) {
        const auto place = survey.reference->referenceAt(point.world);
        text += place ? fmt::format("{:.3f},{:.3f},{:.10g},{:.10g},{}\n", point.distance, point.along,
                                    place->x, place->y, heightCell(point.height))
                      : fmt::format("{:.3f},{:.3f},,,{}\n", point.distance, point.along,
                                    heightCell(point.height));
    }
    return text;
}

int runProfile(const GroundLineOptions& options) {
    checkProfileOptions(options);
    CommandResult result("profile", options.telling, {{"--csv", options.csv}, {"--svg", options.svg}});
    ProgressBar bar(!options.telling.quiet);
    const SurveyGround survey = loadSurveyGround(options.scene, bar.progress());
    const std::vector<WorldLine> lines = linesOnGround(survey, options.line);
    checkNotRead({{"--csv", options.csv}, {"--svg", options.svg}});
    const WorldLine& line = lines.front();
    if (line.closed || lines.size() > 1)
        throw Error(options.line.track, "",
                    line.closed ? "expected a line, found an area"
                                : fmt::format("expected one line, found {}", lines.size()),
                    "leave the others out of the file");
    const GroundSamples samples = survey.samples();
    const std::vector<LinePoint> points = groundLine(samples, line.world);
    const LineMeasure measure = measureLine(samples, line.world);
    if (!options.csv.empty()) writeTextFile(options.csv, tableOf(survey, points));
    if (!options.svg.empty())
        writeTextFile(options.svg, profileChart(points, line.name.empty() ? survey.name : line.name));
    bar.clear();
    result.answer(
        fmt::format("{:.6g} m over the plan, {:.6g} m along the ground, {:.6g} to {:.6g} m high, climb "
                    "{:.6g} m, descent {:.6g} m; {} places\n",
                    measure.plan, measure.along, measure.lowest, measure.highest, measure.climb,
                    measure.descent, points.size()));
    result.addScene(survey.name);
    result.add("crs", survey.crs);
    result.add("name", line.name);
    result.add("sample_spacing_m", FactNumbers{samples.spacing().x, samples.spacing().y});
    result.add("points", static_cast<std::int64_t>(points.size()));
    result.add("plan_m", measure.plan);
    result.add("along_m", measure.along);
    result.add("lowest_m", measure.lowest);
    result.add("highest_m", measure.highest);
    result.add("climb_m", measure.climb);
    result.add("descent_m", measure.descent);
    if (!options.csv.empty()) result.addFile("csv", options.csv);
    if (!options.svg.empty()) result.addFile("svg", options.svg);
    result.finish();
    return 0;
}

}  // namespace

Command profileCommand() {
    return {.name = "profile",
            .help = "list the heights of the ground along a line, a track or a flight",
            .scenes = scene_type::kTerrains,
            .command = command::kProfile,
            .traits = command::kOfGround | command::kTelling,
            .chapter = Chapter::Ground,
            .start = startOf<GroundLineOptions, runProfile>};
}

}  // namespace stereonav
