// The terrain the program can always fly: mountains generated from a seed (uplift, flowing water,
// rockfall, fine fractal detail) with a colour image of their own. Made once and kept in the cache.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/progress.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

constexpr int kBuiltInTexels = 3;  // texels a sample, each way

struct BuiltInTerrain {
    int size = 0;                // samples a side
    double spacing = 30.0;       // metres between samples, both ways
    std::vector<float> heights;  // metres, size * size, row 0 southernmost
    // Base colour with the light of the default look's sun baked in, kBuiltInTexels * size texels a side over
    // the same extent as the samples (outer edges of the texels on the outer samples), row 0 northernmost.
    Plane<PackedColor> color;
};

// Returns the generated terrain, lit by the default look's sun. size: samples a side, kBuiltInSizeMin to
// kBuiltInSizeMax (throws Error outside). The same seed and size give the same bits for any number of
// threads. Read from cacheFolder() where it lies there whole; otherwise made (about a second at 513) and put
// there; a damaged copy is made anew, and a cache that can not be written is done without. Throws Cancelled.
BuiltInTerrain builtInTerrain(std::uint64_t seed, int size, Progress& progress);

// Makes the same without the cache, under the sun of a look; without a look the colours hold no light.
BuiltInTerrain generateBuiltInTerrain(std::uint64_t seed, int size, Progress& progress,
                                      const std::optional<TerrainLook>& look = TerrainLook());

}  // namespace stereonav
