// The vector kernels of the inverse warp, one for each instruction set, and the choice at run time.
#pragma once

#include "engine/simd/simd_target.h"
#include "engine/stereo/warp_row.h"

namespace stereonav {

// Returns the function for the instruction set of availableTarget(), which throws Error where this processor
// does not have it.
ResampleFunction resampler(SimdTarget target = SimdTarget::Auto);

}  // namespace stereonav
