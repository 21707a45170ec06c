// The instruction sets of this machine that kernels are tested on.
#pragma once

#include <vector>

#include "engine/base/error.h"
#include "engine/math/simd_target.h"

namespace stereonav::test {

inline std::vector<SimdTarget> targets() {
    std::vector<SimdTarget> all{SimdTarget::Plain};
    for (const SimdTarget t : {SimdTarget::Avx2, SimdTarget::Avx512}) try {
            all.push_back(availableTarget(t));
        } catch (const Error&) {
        }
    return all;
}

}  // namespace stereonav::test
