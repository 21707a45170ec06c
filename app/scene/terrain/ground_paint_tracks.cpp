#include "app/scene/terrain/ground_paint_tracks.h"

#include <fmt/format.h>

#include <numbers>
#include <optional>

#include "app/scene/terrain/earth_alone.h"
#include "engine/base/error.h"
#include "engine/text/length_text.h"
#include "terrain/paint/track_painter.h"
#include "terrain/read/raster_file.h"
#include "terrain/scene/followed_track.h"

namespace stereonav {
namespace {

constexpr const char* kTrackDoes = "has places on the Earth";

// Ground without a place on the Earth takes degrees as metres, like `profile` and `measure`.
std::optional<glm::dvec2> worldOfTrack(const TerrainScene& terrain, const glm::dvec2& degrees) {
    if (!terrain.earth) return degrees;
    return terrain.earth->worldAt({degrees.y * std::numbers::pi / 180, degrees.x * std::numbers::pi / 180});
}

const char* trackAdvice(const TerrainScene& terrain) {
    return terrain.earth ? "take a larger elevation model, or another track"
                         : "the elevation model does not say where it lies: give metres from its middle";
}

}  // namespace

std::shared_ptr<const EyePainter> trackPainter(const TerrainScene& terrain, const Fog& fog,
                                               const std::string& file, PaintLegend& legend) {
    expectEarth(terrain.body, file, kTrackDoes);
    const TrackFile read = readTrackFile(file);
    std::vector<std::vector<glm::dvec2>> lines;
    std::vector<glm::dvec2> places;
    long long lost = 0;  // vertices that have no place in the ground's reference system
    for (const TrackLine& track : read.lines) {
        std::vector<glm::dvec2> line;
        for (const glm::dvec2& degrees : track.degrees)
            if (const auto world = worldOfTrack(terrain, degrees))
                line.push_back(*world);
            else
                ++lost;
        legend.lines.push_back({track.name, track.closed && line.size() > 2, line});
        if (legend.lines.back().closed) line.push_back(line.front());
        lines.push_back(std::move(line));
    }
    long long beside = 0;
    for (const TrackPlace& place : read.places) {
        const auto world = worldOfTrack(terrain, place.degrees);
        if (world && terrain.ground.contains(*world)) {
            places.push_back(*world);
            legend.places.push_back({place.name, {*world, terrain.ground.heightAt(*world)}});
        } else {
            ++beside;
        }
    }
    auto painter = std::make_shared<TrackPainter>(terrain.ground, fog, lines, places);
    const double length = painter->length(), outside = painter->lengthOutside();
    if (!(length > 0) && places.empty() && beside + lost == 0)
        throw Error(file, "", "no line of it has 2 places that differ", "a line has two ends");
    if (!(outside < length) && places.empty())
        throw Error(file, "", "all of it lies outside the ground", trackAdvice(terrain));
    std::string drawn;
    if (outside < length) drawn = fmt::format("{} of tracks", lengthText(length - outside));
    if (!places.empty())
        drawn += fmt::format("{}{} place{}", drawn.empty() ? "" : ", ", places.size(),
                             places.size() == 1 ? "" : "s");
    legend.legends.push_back(
        {"tracks", {{glm::vec3(kTrackInk[0], kTrackInk[1], kTrackInk[2]), std::move(drawn)}}});
    // Rounding at the ground's edge is not reported as part of a track outside.
    if (outside > 1e-9 * length)
        legend.notes.push_back(fmt::format("{}: {} of {} lie outside the ground and are not drawn", file,
                                           lengthText(outside), lengthText(length)));
    if (beside + lost > 0)
        legend.notes.push_back(
            fmt::format("{}: {} places lie outside the ground and are not drawn", file, beside + lost));
    return painter;
}

RecordedPath followedTrack(const TerrainScene& terrain, const std::string& file, double height) {
    expectEarth(terrain.body, file, kTrackDoes);
    const std::vector<TrackLine> tracks = joinedSegments(readTrackFile(file).lines);
    if (tracks.size() != 1)
        throw Error(file, "", fmt::format("expected one track, found {}", tracks.size()),
                    "leave the others out of the file");
    const TrackLine& track = tracks.front();
    std::vector<glm::dvec2> line;
    for (const glm::dvec2& degrees : track.degrees) {
        const auto world = worldOfTrack(terrain, degrees);
        if (world && terrain.ground.contains(*world)) line.push_back(*world);
    }
    const std::size_t all = track.degrees.size();
    if (line.size() < all)
        throw Error(file, track.name,
                    fmt::format("{} of {} places lie outside the ground", all - line.size(), all),
                    trackAdvice(terrain));
    if (track.closed && line.size() > 2) line.push_back(line.front());
    if (!terrain.tiled) return followTrack(terrain.ground, line, height, file);
    const GroundLevels& levels = *terrain.tiled->levels;
    const int level = terrain.tiled->level;
    return followTrack(terrain.ground, line, height, file,
                       [&](const glm::dvec2& place) { return levels.errorBoundAt(level, place); });
}

}  // namespace stereonav
