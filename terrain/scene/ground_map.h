// A terrain from straight above, north up: its own colours, with the relief shaded where they contain no
// sunlight. Its cost depends on the map's pixels, not on the elevation model's samples: heights are read at
// 16 places per pixel, colours from the texture's level for that size.
#pragma once

#include <glm/vec2.hpp>

#include "engine/base/progress.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

struct GroundMap {
    Plane<PackedColor> picture;  // row 0 northernmost
    glm::dvec2 northWest{0.0};   // world x, y in metres of the outer corner of the first pixel
    double metresPerPixel = 1;
};

constexpr int kMostMapPixels = 4096;  // a side

// Draws the map. most: pixels of the longer side, clamped to 1..kMostMapPixels. Pixels that lie mostly over
// holes are hatched in grey. Reads no data that change with the sun, so that any thread may call it while
// frames are made. Throws Cancelled.
GroundMap mapOfGround(const TerrainScene& terrain, int most, Progress& progress);

}  // namespace stereonav
