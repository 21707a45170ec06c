// `stereonav measure`: lengths, areas and volumes on the ground, each with what the sample spacing leaves
// open.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/output/command_result.h"
#include "app/output/output_place.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/survey_line.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "terrain/survey/ground_area.h"
#include "terrain/survey/ground_line.h"

namespace stereonav {
namespace {

// A figure by its name in JSON, GeoJSON and CSV.
struct Measured {
    const char* key;
    const char* label;
    const char* unit;
    double value, error;
};
struct MeasuredLine {
    WorldLine line;
    std::vector<Measured> figures;
};

std::vector<Measured> figuresOfLine(const Heightfield& ground, const WorldLine& line) {
    const LineMeasure m = measureLine(ground, line.world), e = errorsOfLine(ground, line.world);
    return {{"plan_m", "over the plan", "m", m.plan, 0},
            {"straight_m", "straight", "m", m.straight, e.straight},
            {"along_m", "along the ground", "m", m.along, e.along},
            {"rise_m", "height difference", "m", m.rise, e.rise},
            {"climb_m", "climb", "m", m.climb, e.climb},
            {"descent_m", "descent", "m", m.descent, e.descent},
            {"lowest_m", "lowest", "m", m.lowest, e.lowest},
            {"highest_m", "highest", "m", m.highest, e.highest}};
}

std::vector<Measured> figuresOfArea(const Heightfield& ground, const WorldLine& line,
                                    const std::optional<double>& given) {
    const double lowest = measureArea(ground, line.world, 0).lowest, plane = given.value_or(lowest);
    const AreaMeasure m = measureArea(ground, line.world, plane), e = errorsOfArea(ground, line.world, plane);
    return {{"area_m2", "area over the plan", "m2", m.plan, 0},
            {"surface_m2", "area along the ground", "m2", m.along, e.along},
            {"perimeter_m", "border over the plan", "m", m.perimeter, 0},
            {"plane_m", "plane", "m", plane, 0},
            {"above_m3", "volume over it", "m3", m.above, e.above},
            {"below_m3", "volume under it", "m3", m.below, e.below},
            {"lowest_m", "lowest", "m", m.lowest, e.lowest},
            {"highest_m", "highest", "m", m.highest, e.highest}};
}

void checkMeasureOptions(const MeasureOptions& options) {
    if (options.line.places.empty() && options.area.empty() && options.line.track.empty())
        throw Error("--line", "", "is required, or --area, or --track", "say what is to be measured");
    if (options.plane_m && options.area.empty() && options.line.track.empty())
        throw Error("--plane", "", "has an effect on areas alone", "leave it out, or give --area");
    for (const NamedPlace& output :
         {NamedPlace{"--csv", options.csv}, NamedPlace{"--geojson", options.geojson}}) {
        if (output.place.empty()) continue;
        checkNoInput(output, inputsOf(options.scene));
        checkNoInput(output, inputsOf(options.line));
        checkOutputFile(output.option, output.place);
    }
}

// Longitude and latitude, as the format asks for; of a ground that does not say where it lies its own metres.
nlohmann::ordered_json geometryOf(const SurveyGround& survey, const WorldLine& line) {
    nlohmann::ordered_json places = nlohmann::ordered_json::array();
    const auto add = [&](const glm::dvec2& world) {
        glm::dvec2 at = world;
        if (survey.earth)
            if (const auto earth = survey.earth->placeAt(world))
                at = glm::dvec2(earth->longitude, earth->latitude) * (180 / std::numbers::pi);
        const double height = survey.ground.heightAt(world);
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
            {"name", one.line.name}, {"ground", survey.name}, {"crs", survey.crs}};
        for (const Measured& figure : one.figures) {
            properties[figure.key] = figure.value;
            properties[std::string(figure.key) + "_error"] = figure.error;
        }
        features.push_back(
            {{"type", "Feature"}, {"properties", properties}, {"geometry", geometryOf(survey, one.line)}});
    }
    return nlohmann::ordered_json{{"type", "FeatureCollection"}, {"features", features}}.dump(1) + "\n";
}

// A text in quotes where it holds what parts a table.
std::string tableText(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string csvOf(const std::vector<MeasuredLine>& all) {
    std::string text = "number,name,figure,value,error,unit\n";
    int number = 0;
    for (const MeasuredLine& one : all) {
        ++number;
        for (const Measured& figure : one.figures)
            text += fmt::format("{},{},{},{:.10g},{:.3g},{}\n", number, tableText(one.line.name), figure.key,
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
        std::string words = one.line.name.empty() ? "" : one.line.name + "\n";
        for (const Measured& figure : one.figures) {
            facts.push_back(factForJson(figure.key, figure.value));
            facts.push_back(factForJson(std::string(figure.key) + "_error", figure.error));
            words += fmt::format("  {:<22}{:.7g} {}{}\n", figure.label, figure.value, figure.unit,
                                 figure.error == 0             ? ""
                                 : std::isfinite(figure.error) ? fmt::format(" +- {:.2g}", figure.error)
                                                               : " (error not known)");
        }
        result.answer(words);
        groups.push_back(std::move(facts));
    }
    result.add("measures", std::move(groups));
}

}  // namespace

int runMeasure(const MeasureOptions& options) {
    checkMeasureOptions(options);
    CommandResult result("measure", options.telling,
                         {{"--csv", options.csv}, {"--geojson", options.geojson}});
    ProgressBar bar(!options.telling.quiet);
    const SurveyGround survey = loadSurveyGround(options.scene, bar.progress());
    std::vector<WorldLine> lines = linesOnGround(survey, options.line);
    if (!options.area.empty()) lines.push_back(lineOnGround(survey, options.area, true, "--area"));
    checkNotRead({{"--csv", options.csv}, {"--geojson", options.geojson}});
    std::vector<MeasuredLine> all;
    for (const WorldLine& line : lines)
        all.push_back({line, line.closed ? figuresOfArea(survey.ground, line, options.plane_m)
                                         : figuresOfLine(survey.ground, line)});
    if (!options.csv.empty()) writeTextFile(options.csv, csvOf(all));
    if (!options.geojson.empty()) writeTextFile(options.geojson, geoJsonOf(survey, all));
    bar.clear();
    result.add("scene", survey.name);
    result.add("crs", survey.crs);
    tell(all, result);
    if (!options.csv.empty()) result.addFile("csv", options.csv);
    if (!options.geojson.empty()) result.addFile("geojson", options.geojson);
    result.finish();
    return 0;
}

}  // namespace stereonav
