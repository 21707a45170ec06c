// Chooses the widest kernel that the processor has.
#include "engine/stereo/row_kernels.h"

#include "engine/math/kernel_sets.h"
#include "engine/math/simd_target.h"

namespace stereonav {

STEREONAV_EACH_SET(void resampleRow(const ResampleRow& row);)

Resamplers resamplers() {
    const SimdTarget widest = availableTarget(SimdTarget::Auto);
    return {{"plain", plain::resampleRow, true},
            {"avx2", avx2::resampleRow, widest >= SimdTarget::Avx2},
            {"avx512", avx512::resampleRow, widest >= SimdTarget::Avx512}};
}

ResampleFunction fastestResampler() {
    const Resamplers all = resamplers();
    if (all.avx512.supported) return all.avx512.function;
    return all.avx2.supported ? all.avx2.function : all.plain.function;
}

}  // namespace stereonav
