// The pieces of a lumen: which a seed holds, how long they are, their order from rectum to caecum; and the
// lumen volume made of them.
#pragma once

#include <vector>

#include "colon/segmentation/segmentation.h"
#include "engine/volume/components.h"

namespace stereonav {

// A set of voxels and its components.
struct Pieces {
    VoxelRuns runs;
    Components parts;
};

// Options that give places.
constexpr const char *kSeedOption = "--seed", *kIncludeOption = "--include", *kExcludeOption = "--exclude";

// Returns the voxel nearest to a place that was given: world, metres. Throws Error when it is not finite or
// lies outside the volume.
glm::ivec3 givenVoxel(const VolumeFrame& frame, const char* option, const glm::dvec3& place);
// Returns "--seed x,y,z" in millimetres, as the option is given and as errors name it. place: metres.
std::string givenName(const char* option, const glm::dvec3& place);

// Ways through a piece on a grid of blocks of at most 8^3 voxels: enough to walk from end to end. Places:
// world, metres.
struct PieceWay {
    glm::dvec3 lowest{0.0};      // its lowest place, where the back counts as low too
    glm::dvec3 ends[2];          // the two places farthest from each other along the piece
    glm::dvec3 fromLowest{0.0};  // the place farthest from `lowest`
    double length = 0;           // metres between the ends, along the piece, within a block or two
};
PieceWay wayThrough(const Pieces& pieces, int piece, const VolumeFrame& frame);

// Returns the kept pieces from rectum to caecum: the one with the lowest place first, then always the one
// with the end that is nearest to where the last one ended.
std::vector<int> orderOf(const Pieces& pieces, const std::vector<int>& kept, const VolumeFrame& frame);

// Voxels of a margin around the lumen, which smoothing and normals look at.
constexpr int kLumenMargin = 4;

// Where the frame of a lumen lies in the study's; may reach beyond the study.
struct LumenCrop {
    glm::ivec3 first{0};  // voxel of the study
    VolumeFrame frame;
};
// Returns the box of the pieces and a margin, as far as the study reaches; where a piece touches the study's
// face the margin goes beyond, so that the lumen is closed there.
LumenCrop cropAround(const Pieces& pieces, const std::vector<int>& kept, const VolumeFrame& study);
LumenCrop cropAround(glm::ivec3 first, glm::ivec3 last, int margin, const VolumeFrame& study);

// Throws Error where what is made of a lumen in this crop does not fit into the memory that can be had.
void checkLumenMemory(const LumenCrop& crop);

// Sets lumen and segments of a LumenField from pieces in order. `pieces` lies in the frame of `lumen.field`.
void setSegments(const Pieces& pieces, const std::vector<int>& ordered, LumenField& lumen);

}  // namespace stereonav
