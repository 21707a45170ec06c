// Vectors of kLanes numbers for kernels that are compiled once for each instruction set (see
// cmake/rooms.cmake): float (F), 32-bit integer (I), double (D) and mask (M). Everything is forced
// inline and lives in the instruction set's own namespace, so that no wide instruction leaks into code
// that runs on every processor. No function contracts a*b+c by itself; mulAdd() may.
#pragma once

// Sanitized builds leave the choice to the compiler: instrumented code all in one function takes minutes.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define STEREONAV_INLINE inline
#else
#define STEREONAV_INLINE inline __attribute__((always_inline))
#endif

#if defined(STEREONAV_ISA_avx512)
#include "engine/simd/simd_avx512.h"
#elif defined(STEREONAV_ISA_avx2)
#include "engine/simd/simd_avx2.h"
#else
#include "engine/simd/simd_plain.h"
#endif

namespace stereonav::STEREONAV_ISA {

STEREONAV_INLINE F operator-(F a) {
    return F(0.0f) - a;
}
STEREONAV_INLINE F lerp(F a, F b, F t) {
    return mulAdd(b - a, t, a);
}
STEREONAV_INLINE F clamp(F x, F low, F high) {
    return min(max(x, low), high);
}
STEREONAV_INLINE I clamp(I x, I low, I high) {
    return min(max(x, low), high);
}
STEREONAV_INLINE F abs(F a) {
    return max(a, F(0.0f) - a);
}

}  // namespace stereonav::STEREONAV_ISA
