// A terrain from straight above, north up: its own colours, with the relief shaded where they hold no sun's
// light. What it costs goes with the map's pixels and not with the elevation model's samples: heights are
// read at 16 places a pixel, colours from the texture's level that suits.
#pragma once

#include <glm/vec2.hpp>

#include "engine/base/progress.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

struct GroundMap {
    Plane<PackedColor> picture;  // row 0 northernmost
    glm::dvec2 northWest{0.0};   // world x, y, metres, of the outer corner of its first pixel
    double metresPerPixel = 1;
};

constexpr int kMostMapPixels = 4096;  // a side

// Draws the map. most: pixels of the longer side, cut to 1..kMostMapPixels. Pixels that lie mostly over holes
// are hatched in greys. Reads nothing that changes with the sun: may be called on any thread while frames are
// made. Throws Cancelled.
GroundMap mapOfGround(const TerrainScene& terrain, int most, Progress& progress);

}  // namespace stereonav
