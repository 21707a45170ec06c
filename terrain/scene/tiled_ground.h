// Ground whose samples do not all fit into memory: they lie in tiles on disk, which are made when such a file
// is first opened.
#pragma once

#include <memory>

#include "engine/base/progress.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

class GroundLevels;
struct TerrainScene;

// Whether the file's ground goes into tiles: where it was wished, or where it takes more memory than can be
// had and that was not ruled out. bytesOfSamples: returns the bytes that a scene of `samples` samples holds.
// Throws Error as readDem() does.
bool goesIntoTiles(const SceneFile& file, double (*bytesOfSamples)(double samples));

// Sets scene.tiled, and scene.ground to the finest level that leaves room for what lies around an eye. Where
// tiles are not there yet and file.standInSide wishes so, and the file gives some samples of all of it soon:
// scene.standIn and scene.ground. Missing samples stay open. Returns what readDem() does, without heights.
// Throws Error: as readDem() does, and where the cache has no room for the tiles; Cancelled.
DemGrid readTiledGround(const SceneFile& file, TerrainScene& scene, Progress& progress);

// The levels alone, for who needs no scene; tiles are made where they are not there yet.
struct GroundInTiles {
    DemGrid place;  // what readDem() gives, without heights
    std::shared_ptr<const GroundLevels> levels;
};
// Throws as readTiledGround().
GroundInTiles readGroundInTiles(const SceneFile& file, Progress& progress);

// Returns the finest level that has at most `mostSamples` samples; the coarsest where none has.
int levelWithin(const GroundLevels& levels, double mostSamples);

// The most samples held of a whole ground whose finest samples do not fit into memory: more would only take
// longer to open.
constexpr double kMostCoarseSamples = 1 << 24;

}  // namespace stereonav
