// What of a volume is seen, coarsely: how many of its voxels, in blocks of some voxels. For decisions that
// need no voxel alone: where it is looked at from, which way up it is.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/camera/first_view.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Whether a stored number is seen, by number + 32768.
using SeenNumbers = std::vector<std::uint8_t>;
// Returns those from this stored number on.
SeenNumbers seenFrom(double stored);

struct SeenBlocks {
    glm::ivec3 size{0};                 // blocks along i, j, k; at most kMostBlocks each
    glm::ivec3 block{1};                // voxels of a block, about as long as wide
    VolumeFrame frame;                  // frame of the volume
    std::vector<std::uint32_t> voxels;  // that are seen, by block; i runs fastest

    static constexpr int kMostBlocks = 96;

    std::size_t index(const glm::ivec3& place) const {
        return (static_cast<std::size_t>(place.z) * size.y + place.y) * size.x + place.x;
    }
    bool contains(const glm::ivec3& p) const {
        return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < size.x && p.y < size.y && p.z < size.z;
    }
    // 0 outside.
    std::uint32_t at(const glm::ivec3& place) const { return contains(place) ? voxels[index(place)] : 0; }
    // World place of a block's middle.
    glm::dvec3 middle(const glm::ivec3& place) const;
};

// Counts in one pass over the voxels. seen: of 65536.
SeenBlocks seenBlocks(const GreyVolume& grey, const SeenNumbers& seen);

// Empties blocks of pieces that are apart from the rest and hold less than a two-thousandth of what is seen:
// noise and crumbs. Pieces hang together by faces, edges and corners. Does nothing where that is most of it.
void dropCrumbs(SeenBlocks& blocks);

// Returns the blocks with an empty neighbour at a face, with normals by what is seen around them.
std::vector<SurfaceSample> surfaceOf(const SeenBlocks& blocks);

}  // namespace stereonav
