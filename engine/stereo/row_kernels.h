// The vector kernels of the inverse warp, one for each instruction set, and the choice at run time.
#pragma once

#include "engine/simd/simd_target.h"
#include "engine/stereo/warp_row.h"

namespace stereonav {

// Returns the function of the set that availableTarget() gives, which throws for one that can not be used
// here.
ResampleFunction resampler(SimdTarget target = SimdTarget::Auto);

}  // namespace stereonav
