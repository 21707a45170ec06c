// Chooses the widest kernel that the processor has.
#include "engine/stereo/row_kernels.h"

namespace stereonav {

namespace plain {
void resampleRow(const ResampleRow& row);
}
namespace avx2 {
void resampleRow(const ResampleRow& row);
}
namespace avx512 {
void resampleRow(const ResampleRow& row);
}

Resamplers resamplers() {
    const bool avx2Supported = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool avx512Supported = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                                 __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                                 __builtin_cpu_supports("avx512cd");
    return {{"plain", plain::resampleRow, true},
            {"avx2", avx2::resampleRow, avx2Supported},
            {"avx512", avx512::resampleRow, avx512Supported}};
}

ResampleFunction fastestResampler() {
    const Resamplers all = resamplers();
    if (all.avx512.supported) return all.avx512.function;
    return all.avx2.supported ? all.avx2.function : all.plain.function;
}

}  // namespace stereonav
