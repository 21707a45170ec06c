// Light at finer samples than those of the ground in memory, tile by tile: of each tile the ground around it
// at its own samples, and beyond that the ground in memory, whose light is also what bounces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "engine/base/progress.h"
#include "terrain/ground/ground_levels.h"
#include "terrain/ground/ground_rays.h"
#include "terrain/light/light_rows.h"
#include "terrain/light/light_tiles.h"

namespace stereonav {

class Peers;

class FineBake {
public:
    // Prepares the bake. ground: a level of `levels`, at whose samples `light` was baked (stride 1). Of
    // `light` the settings, grid and, where it has bounces, `full` are read. levels and ground must outlive
    // this. Throws Error where the memory would not suffice.
    FineBake(const GroundLevels& levels, const Heightfield& ground, const TerrainLight& light);

    // Bakes one tile's light, by all threads. Where the model differs from bakeTerrainLight(): rays go over
    // the tile's own samples to 256 of them around it, then over those of `ground`; what is met sends out the
    // light that `ground` has after all bounces, so that there is one more. Nothing where no sample is known.
    // each: called every few samples, as a tile takes seconds; may throw.
    std::optional<TerrainLight> tile(int level, const glm::ivec2& low, const glm::ivec2& size,
                                     const std::function<void()>& each) const;

    // Returns the bytes that a FineBake takes, with the rays over the ground.
    static double memoryOf(const Heightfield& ground, const TerrainLightSettings& settings);

private:
    const GroundLevels& mLevels;
    const Heightfield& mGround;
    const TerrainLightSettings mSettings;
    const LightGrid mGrid;
    const int mCount;  // of harmonics
    const GroundHorizon mWhole;
    std::optional<GroundRays> mWholeRays;  // where there are bounces
    const SkyTransfer mSky;
    TransferField mSent;  // of the ground
};

// Returns the number by which a sample's rays are chosen, of a level of `all` samples: another one for each
// sample of all tiles and levels.
std::uint64_t numberOfSample(int level, const glm::ivec2& all, const glm::ivec2& sample);

// Returns what is baked for a ground whose light, at samples of `level`, is `light`. finer: how many levels
// further than it, 1 or more, as far as there are any.
FineLightShape fineLightShape(const GroundLevels& levels, int level, const TerrainLight& light, int finer);

// Makes LIGHT.fine in its place from `part`, which an earlier run that was stopped may have left. peers: all
// of them, who bake tiles for the first, which alone writes. Throws Error, Cancelled (what is done is kept),
// PeerFailure.
void bakeFineLight(const FineBake& bake, const std::filesystem::path& place,
                   const std::filesystem::path& part, const FineLightShape& shape, Progress& progress,
                   Peers& peers);

}  // namespace stereonav
