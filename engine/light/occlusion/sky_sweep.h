// What a volume hides of the sky and of a key light, everywhere at once: a coarse grid of opacity is swept
// along 42 directions, slab by slab, each cell taking the light of the cells before it (half-angle slicing,
// Kniss et al. 2003, section 4.2, turned into a grid that light stays in). Each slab mixes four cells of the
// one before, which spreads a direction's light about as its share of the sphere is wide. A tenth of a second
// for 1.5 million cells on two threads.
//
// What is far hides less: light that is lost comes back with the distance, by exp(-d / reach).
#pragma once

#include <cstddef>
#include <memory>

#include "engine/base/progress.h"
#include "engine/volume/studio_look.h"
#include "engine/volume/volume_scene.h"

namespace stereonav {

struct SkySweepSetting {
    glm::dvec3 keyFrom{0, 0, 1};  // unit world: where the key light comes from
    double reach = 0;             // metres; 0: light does not come back
    double keyWidth = 0.09;       // radians from the middle of the key light to its edge
    std::size_t mostCells = kMostSkyCells;
    static constexpr std::size_t kMostSkyCells = 1'500'000;
};

// Returns the grid. The object is what the scene shows: voxels that reach the isovalue or, with a transfer
// function, all that takes light. All is open beyond the volume. The same bytes for any thread count and
// instruction set. Throws Error (less than 2 voxels along an axis), Cancelled.
SkyGrid sweepSky(const VolumeScene& scene, const SkySweepSetting& setting, Progress& progress);

// Returns bytes that sweepSky() takes at most, with what it returns.
double skySweepWorking(const VolumeFrame& frame, std::size_t mostCells = SkySweepSetting::kMostSkyCells);

}  // namespace stereonav
