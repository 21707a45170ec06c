// An elevation model's data at one place.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "terrain/raster/earth_places.h"

namespace stereonav {

struct TerrainScene;

struct GroundPlace {
    // Coordinates in the file's own reference system and unit; empty where the ground is in another plane.
    std::optional<glm::dvec2> reference;
    std::optional<EarthPlace> earth;
    double height = 0;  // metres, as in the file: without the vertical scale
    double slope = 0;   // radians from the horizontal, 0 to pi / 2, of the file's heights
    // Direction of steepest descent, radians clockwise from the grid's north (the world's y), 0 to 2 pi;
    // empty on level ground.
    std::optional<double> aspect;
};

// Returns the data at a place; empty outside the ground and in holes. Slope and aspect are those of the
// normals that the ground is shaded with: central differences at the samples (Zevenbergen and Thorne 1987),
// bilinear between them. world: x, y, metres.
std::optional<GroundPlace> groundPlaceAt(const TerrainScene& terrain, const glm::dvec2& world);

}  // namespace stereonav
