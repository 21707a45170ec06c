// The texels of a grid that a bake computes: those that lookups on the possible surfaces touch, in bricks of
// 8^3. The first step of every bake; a background bake asks for each brick that it visits.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/base/progress.h"
#include "engine/volume/illumination_volume.h"

namespace stereonav {

// The choice of texels.
struct TexelChoice {
    // Range of stored values of the surfaces that may be shown. A texel is wanted where it is a corner of a
    // texel cell that a surface with a value in [lowest, highest] passes through: trilinear lookups at points
    // of such a surface touch exactly these.
    float lowest = 0, highest = 0;
    // If not null (same frame as the volume): cells without a voxel inside the region do not count.
    const MaskVolume* region = nullptr;
    bool full = false;  // all texels instead, for any isovalue
};

// The 512 texels of a brick: bit 8 j + i of word k.
using TexelMask = std::array<std::uint64_t, 8>;
int countTexels(const TexelMask& mask);

struct TexelBrick {
    std::uint32_t number = 0;  // x + bricks.x (y + bricks.y z)
    TexelMask wanted{};
};

// Return the position of a brick in the grid of bricks, and the texels of its mask in the order of their
// bits.
glm::ivec3 brickPlace(const TexelLayout& layout, std::uint32_t number);
std::vector<glm::ivec3> texelsIn(const TexelLayout& layout, const TexelBrick& brick);

// Finds the wanted texels of one brick at a time; may be called from any thread.
class TexelChooser {
public:
    // volume (and the region) must outlive this object. texels: from texelFrame() for the volume's frame.
    TexelChooser(const GreyVolume& volume, const VolumeFrame& texels, const TexelChoice& choice);
    TexelMask brick(std::uint32_t number) const;

private:
    bool mayHold(const glm::ivec3& low, const glm::ivec3& high) const;
    bool crossed(const glm::ivec3& cell) const;

    const GreyVolume& mVolume;
    VolumeFrame mTexels;
    TexelLayout mLayout;
    TexelChoice mChoice;
    glm::dvec3 mVoxelsPerTexel;
};

// Returns all bricks with a wanted texel, by number. Throws Cancelled.
std::vector<TexelBrick> wantedBricks(const GreyVolume& volume, const VolumeFrame& texels,
                                     const TexelChoice& choice, Progress& progress);

}  // namespace stereonav
