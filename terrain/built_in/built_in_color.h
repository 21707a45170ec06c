// The colour of the generated terrain: what grows or lies on the ground by height, slope and water,
// with the sun's light, cast shadows and the sky's light baked in.
#pragma once

#include <cstdint>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "terrain/built_in/built_in_relief.h"
#include "terrain/built_in/built_in_terrain.h"

namespace stereonav {

// Returns the ground's colours, kBuiltInTexels * size texels a side over the relief's extent, row 0
// northernmost. look: has the sun whose light is baked in; null: no light, and no small-scale relief, which
// shows by it. Throws Cancelled.
Plane<PackedColor> makeBuiltInColor(const Relief& relief, std::uint64_t seed, const TerrainLook* look,
                                    Progress& progress);

}  // namespace stereonav
