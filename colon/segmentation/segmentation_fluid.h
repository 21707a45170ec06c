// Fluid made bright by a contrast agent: pools with a level surface under the colon's air.
#pragma once

#include <functional>
#include <vector>

#include "colon/segmentation/segmentation_air.h"

namespace stereonav {

// A column that crosses the film between fluid and air. Voxels of the study.
struct FilmColumn {
    glm::ivec3 fluid{0};  // clean fluid below the film
    int air = 0;          // along the upright axis: the first clean air above it
};

// A pool of fluid, and the film over it.
struct Pool {
    std::size_t core = 0;  // number among FluidPools::cores
    double hu = 0;         // median, HU
    std::vector<FilmColumn> film;
};

struct FluidPools {
    Pieces cores;  // bright voxels with six bright neighbours: bone joined by a film falls off
    int axis = 1;  // axis along which fluid lies under air
    int up = -1;   // step along it towards the air, 1 or -1
    std::vector<Pool> pools;
};

// Finds the pools that belong to the colon; pieces of air that they touch become Colon in `air`. Pools that
// hold a place that was given are taken, or left out, whatever their surface.
FluidPools findFluid(const GreyVolume& study, const SegmentationSetting& setting, AirPieces& air);

// Returns the pools that lie in a lumen known from before (a voxel of the study: true inside). The kinds of
// `air` are known too.
FluidPools poolsInside(const GreyVolume& study, const SegmentationSetting& setting, const AirPieces& air,
                       const std::function<bool(const glm::ivec3&)>& inside);

// Turns fluid into air in `field` (HU), which lies at voxel `first` of the study; marks it in `inside`.
void cleanseFluid(const FluidPools& fluid, const SegmentationSetting& setting, const glm::ivec3& first,
                  GreyVolume& field, MaskVolume& inside);

}  // namespace stereonav
