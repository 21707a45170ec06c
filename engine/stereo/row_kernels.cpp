#include "engine/stereo/row_kernels.h"

#include "engine/simd/kernel_sets.h"

namespace stereonav {

STEREONAV_EACH_SET(void resampleRow(const ResampleRow& row);)

ResampleFunction resampler(SimdTarget target) {
    return kernelsOf<ResampleFunction>(target, plain::resampleRow, avx2::resampleRow, avx512::resampleRow);
}

}  // namespace stereonav
