#include "app/view/raised_ground.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "engine/text/number.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

constexpr std::string_view kScale = "vertical-scale=";

bool sameGrid(const Heightfield& a, const Heightfield& b) {
    return a.width() == b.width() && a.height() == b.height() && a.spacing() == b.spacing() &&
           a.originWorld() == b.originWorld();
}

}  // namespace

std::optional<RaisedGround> RaisedGround::between(const Scene& before, const Scene& after) {
    const auto *const old = before.offered<const TerrainScene>(), *const now =
                                                                      after.offered<const TerrainScene>();
    if (!old || !now || old->verticalScale == now->verticalScale) return std::nullopt;
    if (!sameGrid(old->ground, now->ground)) return std::nullopt;
    return RaisedGround(now->ground, old->verticalScale / now->verticalScale);
}

std::optional<RaisedGround> RaisedGround::since(const Bookmark& place, const Scene& now) {
    const auto* const terrain = now.offered<const TerrainScene>();
    if (!terrain || !place.settings.starts_with(kScale)) return std::nullopt;
    const std::string text = place.settings.substr(kScale.size());
    const auto then = numberOf(text.substr(0, text.find('\n')));
    if (!then || !(*then > 0) || *then == terrain->verticalScale) return std::nullopt;
    return RaisedGround(terrain->ground, *then / terrain->verticalScale);
}

// Moves a place with the ground below it. Beyond the ground's border the nearest place of the border counts;
// over a hole nothing moves.
glm::dvec3 RaisedGround::moved(const glm::dvec3& place) const {
    const glm::dvec2 low = mGround->originWorld(),
                     high = mGround->worldFromGrid({mGround->width() - 1, mGround->height() - 1});
    const glm::dvec2 at = glm::clamp(glm::dvec2(place), glm::min(low, high), glm::max(low, high));
    const double height = mGround->heightAt(at);
    if (!std::isfinite(height)) return place;
    return {place.x, place.y, place.z + height * (1 - mBefore)};
}

Pose RaisedGround::moved(Pose pose) const {
    pose.position = moved(pose.position);
    return pose;
}

RecordedPath RaisedGround::moved(const RecordedPath& path) const {
    if (path.samples().empty()) return path;
    std::vector<PathSample> samples = path.samples();
    for (PathSample& sample : samples) sample.pose = moved(sample.pose);
    return RecordedPath(std::move(samples), "the flight");
}

Keyframes RaisedGround::moved(Keyframes keys) const {
    for (auto& key : keys) key.pose = moved(key.pose);
    return keys;
}

std::string groundSettings(const Scene& scene) {
    const auto* const terrain = scene.offered<const TerrainScene>();
    return terrain ? fmt::format("{}{:.9g}\n", kScale, terrain->verticalScale) : "";
}

Bookmark placeNow(const Bookmark& place, const Scene& now) {
    Bookmark moved = place;
    if (const auto raised = RaisedGround::since(place, now)) moved.pose = raised->moved(place.pose);
    return moved;
}

}  // namespace stereonav
