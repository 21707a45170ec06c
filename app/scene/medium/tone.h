// The tone curve of a medium that is shown: chosen at the start, steady in flight.
#pragma once

#include "engine/image/tone_curve.h"
#include "engine/medium/sweep/medium_scene.h"
#include "engine/scene/scene.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

// Returns the curve under which nothing that a small picture from the start pose shows is clipped; the
// straight line where nothing is brighter than white. `scene` gives pose and lens, `medium` what is seen.
ToneCurve toneOf(const Scene& scene, const MediumScene& medium, SimdTarget simd);

}  // namespace stereonav
