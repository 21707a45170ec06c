// `stereonav measure`: lengths, areas and volumes on the ground, each with its uncertainty from the sample
// spacing.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/command/ground_line_options.h"
#include "app/options/output_place.h"
#include "app/output/command_result.h"
#include "app/output/handed_name.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/terrain/ground_figures.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/text/csv_text.h"
#include "engine/text/json_text.h"

namespace stereonav {
namespace {

struct MeasuredLine {
    WorldLine line;
    std::vector<GroundFigure> figures;
};

void checkMeasureOptions(const GroundLineOptions& options) {
    if (options.line.places.empty() && options.area.empty() && options.line.track.empty())
        throw Error("--line", "", "is required, or --area, or --track", "say what is to be measured");
    if (options.plane_m && options.area.empty() && options.line.track.empty())
        throw Error("--plane", "", "applies to areas only", "leave it out, or give --area");
    for (const NamedPlace& output :
         {NamedPlace{"--csv", options.csv}, NamedPlace{"--geojson", options.geojson}}) {
        if (output.place.empty()) continue;
        checkNoInput(output, inputsOf(options.scene));
        checkNoInput(output, inputsOf(options.line));
        checkOutputFile(output.option, output.place);
    }
}

// Returns longitudes and latitudes, as the format requires; for ground without a place on the Earth its own
// metres.
nlohmann::ordered_json geometryOf(const SurveyGround& survey, const WorldLine& line) {
    nlohmann::ordered_json places = nlohmann::ordered_json::array();
    const GroundSamples samples = survey.samples();
    const auto add = [&](const glm::dvec2& world) {
        glm::dvec2 at = world;
        if (survey.earth)
            if (const auto earth = survey.earth->placeAt(world))
                at = glm::dvec2(earth->longitude, earth->latitude) * (180 / std::numbers::pi);
        const double height = samples.heightAt(world);
        places.push_back(std::isfinite(height) ? nlohmann::ordered_json{at.x, at.y, height}
                                               : nlohmann::ordered_json{at.x, at.y});
    };
    for (const glm::dvec2& world : line.world) add(world);
    if (!line.closed) return {{"type", "LineString"}, {"coordinates", places}};
    add(line.world.front());
    return {{"type", "Polygon"}, {"coordinates", nlohmann::ordered_json::array({places})}};
}

std::string geoJsonOf(const SurveyGround& survey, const std::vector<MeasuredLine>& all) {
    nlohmann::ordered_json features = nlohmann::ordered_json::array();
    for (const MeasuredLine& one : all) {
        nlohmann::ordered_json properties{
            {"name", one.line.name}, {"ground", handedName(survey.name)}, {"crs", survey.crs}};
        for (const GroundFigure& figure : one.figures) {
            properties[figure.key] = figure.value;
            properties[std::string(figure.key) + "_error"] = figure.error;
        }
        features.push_back(
            {{"type", "Feature"}, {"properties", properties}, {"geometry", geometryOf(survey, one.line)}});
    }
    return jsonText(nlohmann::ordered_json{{"type", "FeatureCollection"}, {"features", features}}, 1) + "\n";
}

std::string csvOf(const std::vector<MeasuredLine>& all) {
    std::string text = "number,name,figure,value,error,unit\n";
    int number = 0;
    for (const MeasuredLine& one : all) {
        ++number;
        for (const GroundFigure& figure : one.figures)
            text += fmt::format("{},{},{},{:.10g},{:.3g},{}\n", number, csvText(one.line.name), figure.key,
                                figure.value, figure.error, figure.unit);
    }
    return text;
}

void tell(const std::vector<MeasuredLine>& all, CommandResult& result) {
    std::vector<Facts> groups;
    for (const MeasuredLine& one : all) {
        Facts facts{factForJson("name", one.line.name),
                    factForJson("kind", std::string(one.line.closed ? "area" : "line")),
                    factForJson("places", static_cast<std::int64_t>(one.line.world.size()))};
        if (!one.line.name.empty()) result.answer(one.line.name);
        for (const GroundFigure& figure : one.figures) {
            facts.push_back(factForJson(figure.key, figure.value));
            facts.push_back(factForJson(std::string(figure.key) + "_error", figure.error));
            result.answer(fmt::format("  {:<22}{:.7g} {}{}\n", figure.label, figure.value, figure.unit,
                                      errorText(figure)));
        }
        groups.push_back(std::move(facts));
    }
    result.add("measures", std::move(groups));
}

int runMeasure(const GroundLineOptions& options) {
    checkMeasureOptions(options);
    CommandResult result("measure", options.telling,
                         {{"--csv", options.csv}, {"--geojson", options.geojson}});
    ProgressBar bar(!options.telling.quiet);
    const SurveyGround survey = loadSurveyGround(options.scene, bar.progress());
    std::vector<WorldLine> lines = linesOnGround(survey, options.line);
    if (!options.area.empty()) lines.push_back(lineOnGround(survey, options.area, true, "--area"));
    checkNotRead({{"--csv", options.csv}, {"--geojson", options.geojson}});
    const GroundSamples samples = survey.samples();
    std::vector<MeasuredLine> all;
    for (const WorldLine& line : lines) {
        const auto told = [&](double share) {
            bar.progress().report((double(all.size()) + share) / double(lines.size()), "measuring");
        };
        told(0);
        all.push_back({line, line.closed ? figuresOfArea(samples, line.world, options.plane_m, told)
                                         : figuresOfLine(samples, line.world)});
    }
    if (!options.csv.empty()) writeTextFile(options.csv, csvOf(all));
    if (!options.geojson.empty()) writeTextFile(options.geojson, geoJsonOf(survey, all));
    bar.clear();
    result.addScene(survey.name);
    result.add("crs", survey.crs);
    result.add("sample_spacing_m", FactNumbers{samples.spacing().x, samples.spacing().y});
    tell(all, result);
    if (!options.csv.empty()) result.addFile("csv", options.csv);
    if (!options.geojson.empty()) result.addFile("geojson", options.geojson);
    result.finish();
    return 0;
}

}  // namespace

Command measureCommand() {
    return {.name = "measure",
            .help = "measure lengths, areas and volumes on the ground, each with its error",
            .scenes = scene_type::kTerrains,
            .command = command::kMeasure,
            .traits = command::kOfGround | command::kTelling,
            .chapter = Chapter::Ground,
            .options = groundLineOptions,
            .start = startOf<GroundLineOptions, runMeasure>};
}

}  // namespace stereonav
