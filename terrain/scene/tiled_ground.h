// Ground whose samples do not all fit into memory: they lie in tiles on disk, which are made when the file is
// first opened.
#pragma once

#include <memory>

#include "engine/base/progress.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

class GroundLevels;
struct TerrainScene;

// Returns whether the file's ground is put into tiles: where that was requested, or where it would take more
// memory than is available and tiles were not ruled out. bytesOfSamples: returns the bytes of a scene with
// `samples` samples. Throws Error as readDem() does.
bool goesIntoTiles(const SceneFile& file, double (*bytesOfSamples)(double samples));

// Sets scene.tiled, and scene.ground to the finest level that leaves memory for the ground around an eye. If
// the tiles do not exist yet, file.standInSide asks for a stand-in, and the file can be sampled quickly, sets
// scene.standIn and scene.ground instead. Missing samples stay open. Returns the result of readDem() without
// heights. Throws Error: as readDem() does, and where the cache has no room for the tiles; Cancelled.
DemGrid readTiledGround(const SceneFile& file, TerrainScene& scene, Progress& progress);

// The levels of a ground without a scene; tiles are made if they do not exist yet.
struct GroundInTiles {
    DemGrid place;  // result of readDem() without heights
    std::shared_ptr<const GroundLevels> levels;
};
// Throws as readTiledGround().
GroundInTiles readGroundInTiles(const SceneFile& file, Progress& progress);

// Returns the finest level with at most `mostSamples` samples; the coarsest where there is none.
int levelWithin(const GroundLevels& levels, double mostSamples);

// Largest number of samples held of a whole ground whose finest samples do not fit into memory: more would
// only take longer to open.
constexpr double kMostCoarseSamples = 1 << 24;

}  // namespace stereonav
