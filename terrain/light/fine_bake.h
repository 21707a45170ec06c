// Bakes light at finer samples than those of the ground in memory, tile by tile. Rays go over the tile's own
// samples near it, and beyond them over the ground in memory, whose light is also what they gather as bounced
// light.
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
    // Prepares the bake. ground: a level of `levels`; `light` was baked at all of its samples (stride 1).
    // Reads the settings and the grid of `light` and, where it has bounces, `full`. levels and ground must
    // outlive the object. Throws Error where memory does not suffice.
    FineBake(const GroundLevels& levels, const Heightfield& ground, const TerrainLight& light);

    // Bakes one tile's light on all threads. Returns nothing where none of its samples is known. Differs from
    // bakeTerrainLight() in two ways: up to 256 samples around the tile rays go over the tile's own level,
    // and beyond that over `ground`; and where a ray meets ground it gathers the light that `ground` sends
    // out after all bounces, which adds one bounce. each: called every few samples, since a tile takes
    // seconds; may throw.
    std::optional<TerrainLight> tile(int level, const glm::ivec2& low, const glm::ivec2& size,
                                     const std::function<void()>& each) const;

    // Returns the bytes that a FineBake needs, with what its rays need.
    static double memoryOf(const Heightfield& ground, const TerrainLightSettings& settings);

private:
    const GroundLevels& mLevels;
    const Heightfield& mGround;
    const TerrainLightSettings mSettings;
    const LightGrid mGrid;
    const int mCount;  // number of harmonics
    const GroundHorizon mWhole;
    std::optional<GroundRays> mWholeRays;  // rays over mGround; none without bounces
    const SkyTransfer mSky;
    TransferField mSent;  // light that mGround sends out after all bounces; empty without
};

// Returns the number that selects the random rays of a sample; each sample of every tile and level has
// another one. all: samples of the level each way.
std::uint64_t numberOfSample(int level, const glm::ivec2& all, const glm::ivec2& sample);

// Returns the shape of LIGHT.fine for a ground whose light, baked at the samples of `level`, is `light`.
// finer: how many finer levels to bake, 1 or more; cut where the ground has fewer.
FineLightShape fineLightShape(const GroundLevels& levels, int level, const TerrainLight& light, int finer);

// Bakes LIGHT.fine. Tiles are written to `part`, where the tiles of an earlier run that was stopped are kept,
// and the finished file is moved to `place`. peers: every process calls this; all bake tiles, the first one
// alone writes. Throws Error, Cancelled (finished tiles are kept) and PeerFailure.
void bakeFineLight(const FineBake& bake, const std::filesystem::path& place,
                   const std::filesystem::path& part, const FineLightShape& shape, Progress& progress,
                   Peers& peers);

}  // namespace stereonav
