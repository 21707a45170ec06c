// The model of docs/volume_light.md by the book: one thread of thought, double precision, no skipping. The
// oracle of the kernels and shaders.
#pragma once

#include <span>
#include <vector>

#include "engine/medium/model/medium_picture.h"
#include "engine/medium/sweep/sweep_geometry.h"

namespace stereonav {

// One picture an eye of the geometry.
std::vector<MediumPicture> plainSweep(const Medium& medium, const MediumLook& look,
                                      const SweepSetting& setting, const SweepGeometry& geometry,
                                      double time = 0);

}  // namespace stereonav
