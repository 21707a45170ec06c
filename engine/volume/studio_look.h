// Light that stands still around an object seen from outside, as in a photographer's studio: a sky, of which
// the object itself hides a part from each place, and a key light that casts shadows. The lamp at the head
// stays, weaker. What the object hides is known on a coarse grid (engine/light/occlusion/sky_sweep.h).
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "engine/base/lazy_array.h"
#include "engine/volume/volume.h"

namespace stereonav {

// What each place of a coarse grid sees of the sky and of the key light. Two words a cell, three channels of
// 10 bits each, x lowest. First: the mean of the directions that see the sky, times 4 (a plane's half of them
// gives its normal), 0..1023 for -1..1. Second: the share of all directions that see it, and the share of
// the key light, 0..1023 for 0..1, and nothing.
struct SkyGrid {
    glm::ivec3 size{0};          // cells, at least 2 an axis
    glm::dvec3 first{0.0};       // centre of cell (0, 0, 0), in voxels of the scene's field
    glm::dvec3 cellVoxels{1.0};  // voxels from one cell to the next
    LazyArray<std::uint32_t> words;

    std::size_t count() const { return static_cast<std::size_t>(size.x) * size.y * size.z; }
};

// Cells that a place on a surface is lifted along its normal before it is looked up, so that the surface does
// not hide the sky from itself: cells with a part of a plane in them are less than half a cell off it, and a
// lookup takes in one more.
constexpr double kSkyLift = 1.5;

// The light and its share of the lamp. Colours are linear RGB on white.
struct StudioLook {
    std::shared_ptr<const SkyGrid> seen;       // null: the lamp alone
    glm::vec3 sky{0.0f}, ground{0.0f};         // on a face that sees the whole sky, turned up and down
    glm::vec3 key{0.0f};                       // on a face that the key light falls on along its normal
    glm::dvec3 up{0, 0, 1}, keyFrom{0, 0, 1};  // unit world
    float lamp = 1;                            // share of the lamp's direct light and highlight, 0 to 1
    float lampDeep = 1;                        // share of this that is left where nothing of the sky is seen
};

// Packs what a cell sees. towards: mean of the directions that see the sky, a half at most long; share, key:
// 0 to 1.
void packSky(const glm::dvec3& towards, double share, double key, std::uint32_t* words);

// What a surface sees: the sky's share weighted by the cosine (1: a plane in the open), and the key light's.
struct SkySeen {
    double sky = 1, key = 1;
};

// Returns what a surface at a place in voxels with this normal (world, unit) sees: trilinear, and beyond the
// grid what its outermost cells see. The sky's share is that of its harmonics up to the first order, exact
// for a plane and in the open. frame: the field's.
SkySeen skySeenAt(const SkyGrid& grid, const VolumeFrame& frame, const glm::dvec3& voxel,
                  const glm::dvec3& normal);

// Returns light on white, linear RGB; lamp: the lamp's own, direct.
glm::dvec3 studioLight(const StudioLook& look, const SkySeen& seen, const glm::dvec3& normal, double lamp);
// Returns the share of the lamp that is shown.
double studioLampShare(const StudioLook& look, const SkySeen& seen);

// Returns the matrix that turns a world normal into the normal of the same face in the grid's cells, of any
// length.
glm::dmat3 skyNormals(const SkyGrid& grid, const VolumeFrame& frame);

}  // namespace stereonav
