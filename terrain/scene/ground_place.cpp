#include "terrain/scene/ground_place.h"

#include <cmath>
#include <numbers>

#include "terrain/scene/fine_heights.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

std::optional<GroundPlace> groundPlaceAt(const TerrainScene& terrain, const glm::dvec2& world) {
    if (!terrain.ground.contains(world)) return std::nullopt;
    const auto part = terrain.tiled ? terrain.tiled->fine->around(world) : nullptr;
    if (terrain.tiled && !part) return std::nullopt;
    const Heightfield& ground = part ? *part : terrain.ground;
    const double height = ground.heightAt(world);
    if (!std::isfinite(height)) return std::nullopt;
    GroundPlace place;
    place.height = height / terrain.verticalScale;
    if (terrain.report.sourceUnit > 0)
        place.reference = terrain.report.sourceOffset + world / terrain.report.sourceUnit;
    if (terrain.earth) place.earth = terrain.earth->placeAt(world);
    const glm::dvec3 normal = ground.normalAt(world);
    const double fall = std::hypot(normal.x, normal.y) / terrain.verticalScale;
    place.slope = std::atan2(fall, normal.z);
    if (fall > 0) {
        const double azimuth = std::atan2(normal.x, normal.y);
        place.aspect = azimuth < 0 ? azimuth + 2 * std::numbers::pi : azimuth;
    }
    return place;
}

}  // namespace stereonav
