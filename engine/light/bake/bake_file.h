// A bake's sums in a file, so that the next run continues from there and scenes open with their light.
// docs/formats.md defines the file byte for byte.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/light/bake/bake_sums.h"
#include "engine/light/skies/light_setup.h"

namespace stereonav {

// Everything that the texels' light depends on; bakes with the same key may continue each other.
struct BakeInputs {
    std::uint64_t content = 0;  // the volume's contentHash(), or a value in its place
    LightSetup light;           // for irradiance all of it counts; for transfer albedo and bounces
    TexelSampling sampling;
    VolumeFrame texels;
    TexelChoice choice;  // its region is covered by `content`
    BakeShape shape;
};
std::uint64_t bakeKey(const BakeInputs& inputs);

// Returns a hash of all values and the frame.
std::uint64_t contentHash(const GreyVolume& volume);
// Returns a hash of only the values at texels of bricks (whose grid is the volume's), for volumes that are
// known only near a wall. The whole region is hashed as well.
std::uint64_t contentHashNear(const GreyVolume& volume, const MaskVolume& region,
                              std::span<const TexelBrick> bricks);

// Returns the place of the bake with that key in the cache folder.
std::filesystem::path bakeCacheFile(std::uint64_t key);

struct BakeIdentity {
    std::uint64_t key = 0;  // bakeKey()
    // BakeInputs::content, by which light that a user names is checked to be for this volume.
    std::uint64_t content = 0;
};

struct BakeFile {
    BakeIdentity identity;
    BakeSums sums;
};

// Reads a bake. Empty where there is no such file, and where it is not usable: then `problem` says why, in a
// clause ("is cut off: ..."), else it is "". Never throws for the file's content, but throws Error where the
// disk reports an error; sizes are checked before memory is taken. key: required key; empty: any.
std::optional<BakeFile> readBakeFile(const std::filesystem::path& file, std::optional<std::uint64_t> key,
                                     std::string& problem);

// Returns whether the file exists and does not begin like a bake, so that it should not be overwritten.
bool isForeignFile(const std::filesystem::path& file);

// Writes the file beside its place and renames it. Throws Error.
void writeBakeFile(const std::filesystem::path& file, const BakeIdentity& identity, const BakeSums& sums);

}  // namespace stereonav
