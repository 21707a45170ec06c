#include "app/scene/terrain/survey_line.h"

#include <fmt/format.h>

#include <numbers>

#include "app/scene/terrain/earth_alone.h"
#include "engine/base/error.h"
#include "engine/camera/recorded_path.h"

namespace stereonav {
namespace {

void checkPlaces(WorldLine& line, const std::string& where) {
    std::vector<glm::dvec2> differing;
    for (const glm::dvec2& place : line.world)
        if (differing.empty() || differing.back() != place) differing.push_back(place);
    while (line.closed && differing.size() > 1 && differing.back() == differing.front()) differing.pop_back();
    line.world = std::move(differing);
    const std::size_t least = line.closed ? 3 : 2;
    if (line.world.size() < least)
        throw Error(where, line.name,
                    fmt::format("expected {} places that differ, found {}", least, line.world.size()),
                    line.closed ? "an area has three corners" : "a line has two ends");
}

WorldLine trackOnGround(const SurveyGround& survey, const TrackLine& track, const std::string& file) {
    expectEarth(survey.body, file, "has places on the Earth");
    WorldLine line{track.name, track.closed, {}};
    const GroundSamples samples = survey.samples();
    std::size_t off = 0;
    for (const glm::dvec2& degrees : track.degrees) {
        std::optional<glm::dvec2> world = degrees;
        if (survey.earth)
            world = survey.earth->worldAt(
                {degrees.y * std::numbers::pi / 180, degrees.x * std::numbers::pi / 180});
        if (!world || !samples.contains(*world))
            ++off;
        else
            line.world.push_back(*world);
    }
    if (off > 0)
        throw Error(file, track.name,
                    fmt::format("{} of {} places lie outside the ground", off, track.degrees.size()),
                    survey.earth
                        ? "cut the track, or take a larger elevation model"
                        : "the elevation model does not say where it lies: give metres from its middle");
    checkPlaces(line, file);
    return line;
}

WorldLine flightOnGround(const SurveyGround& survey, const std::string& file) {
    WorldLine line;
    const RecordedPath path = readPath(file);
    const GroundSamples samples = survey.samples();
    for (const PathSample& sample : path.samples()) line.world.emplace_back(sample.pose.position);
    for (const glm::dvec2& world : line.world)
        if (!samples.contains(world))
            throw Error(file, "",
                        fmt::format("the flight leaves the ground at {:.6g},{:.6g}", world.x, world.y),
                        "was it recorded over another one?");
    checkPlaces(line, file);
    return line;
}

}  // namespace

std::vector<NamedPlace> inputsOf(const SurveyLine& line) {
    return {{"--track", line.track}, {"--path", line.path}};
}

WorldLine lineOnGround(const SurveyGround& survey, const std::vector<glm::dvec2>& places, bool closed,
                       const char* option) {
    WorldLine line{"", closed, {}};
    for (const glm::dvec2& place : places)
        line.world.push_back(survey.samples().worldFromGrid(survey.gridAt(place, option)));
    checkPlaces(line, option);
    return line;
}

std::vector<WorldLine> linesOnGround(const SurveyGround& survey, const SurveyLine& line) {
    std::vector<WorldLine> lines;
    if (!line.places.empty()) lines.push_back(lineOnGround(survey, line.places, false, "--line"));
    if (!line.path.empty()) lines.push_back(flightOnGround(survey, line.path));
    if (!line.track.empty())
        for (const TrackLine& track : readTracks(line.track))
            lines.push_back(trackOnGround(survey, track, line.track));
    return lines;
}

}  // namespace stereonav
