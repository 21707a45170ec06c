#include "engine/math/simd_target.h"

#include "engine/base/error.h"

namespace stereonav {

SimdTarget availableTarget(SimdTarget target) {
    const bool hasAvx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool hasAvx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    if (target == SimdTarget::Auto)
        return hasAvx512 ? SimdTarget::Avx512 : hasAvx2 ? SimdTarget::Avx2 : SimdTarget::Plain;
    if ((target == SimdTarget::Avx512 && !hasAvx512) || (target == SimdTarget::Avx2 && !hasAvx2))
        throw Error("", "--simd", "this processor does not have that instruction set", "use auto");
    return target;
}

}  // namespace stereonav
