// The reference model of the sweep: docs/volume_light.md in one thread and double precision, without skipping
// anything. Kernels and shaders are tested against it.
#pragma once

#include <span>
#include <vector>

#include "engine/medium/model/medium_picture.h"
#include "engine/medium/sweep/sweep_geometry.h"

namespace stereonav {

// Returns one picture for each eye of the geometry.
std::vector<MediumPicture> plainSweep(const Medium& medium, const MediumLook& look,
                                      const SweepSetting& setting, const SweepGeometry& geometry,
                                      double time = 0);

}  // namespace stereonav
