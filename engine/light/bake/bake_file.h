// A bake's sums in a file, so that the next run goes on from there and scenes open with their light. What the
// file holds is written out in docs/formats.md, byte for byte.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/light/bake/bake_sums.h"
#include "engine/light/skies/light_setup.h"

namespace stereonav {

// Everything that the texels' light depends on; bakes with the same key may go on from each other.
struct BakeInputs {
    std::uint64_t content = 0;  // the volume's contentHash(), or what stands for it
    LightSetup light;           // all of it for irradiance; for transfer albedo and bounces
    TexelSampling sampling;
    VolumeFrame texels;
    TexelChoice choice;  // the region counts as a part of `content`
    BakeShape shape;
};
std::uint64_t bakeKey(const BakeInputs& inputs);

// Returns a hash of all values and the frame.
std::uint64_t contentHash(const GreyVolume& volume);
// Returns a hash of the values at texels of bricks alone (whose grid is the volume's): for volumes that are
// known near a wall only. The region is counted in whole.
std::uint64_t contentHashNear(const GreyVolume& volume, const MaskVolume& region,
                              std::span<const TexelBrick> bricks);

// Returns the place of the bake with that key in the cache folder.
std::filesystem::path bakeCacheFile(std::uint64_t key);

struct BakeIdentity {
    std::uint64_t key = 0;      // bakeKey()
    std::uint64_t content = 0;  // BakeInputs::content: whether light that someone names is of this volume
};

struct BakeFile {
    BakeIdentity identity;
    BakeSums sums;
};

// Reads a bake. Returns nothing when there is no such file, and when it is of no use: then `problem` says
// why, in a clause ("is cut off: ..."), else it is empty. Throws for nothing that is in the file, but Error
// where the disk reports an error; sizes are checked before memory is taken. key: that it must have; none:
// any.
std::optional<BakeFile> readBakeFile(const std::filesystem::path& file, std::optional<std::uint64_t> key,
                                     std::string& problem);

// Returns whether the file is there and begins as no bake does, so that it should not be written over.
bool isForeignFile(const std::filesystem::path& file);

// Writes the file beside its place and renames it. Throws Error.
void writeBakeFile(const std::filesystem::path& file, const BakeIdentity& identity, const BakeSums& sums);

}  // namespace stereonav
