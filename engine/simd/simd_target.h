// Which of the kernels that are compiled for several instruction sets is run.
//
// The environment variable STEREONAV_SIMD (plain, avx2 or avx512) hides wider sets than it names from the
// whole program, its tests and its benchmarks, so that one machine shows what others do. It is read once.
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace stereonav {

// Auto takes the widest that may be used here.
enum class SimdTarget { Auto, Plain, Avx2, Avx512 };

struct NamedSimdTarget {
    std::string_view name;
    SimdTarget target;
};
constexpr std::array<NamedSimdTarget, 4> kSimdTargets{{{"auto", SimdTarget::Auto},
                                                       {"plain", SimdTarget::Plain},
                                                       {"avx2", SimdTarget::Avx2},
                                                       {"avx512", SimdTarget::Avx512}}};

// Returns one of the names above.
std::string_view nameOf(SimdTarget target);

// Returns the widest set of this processor.
SimdTarget widestOfProcessor();

// Returns the narrower of `has` and what `limit` names; a null or empty limit hides nothing. Throws Error for
// a limit that is no set's name.
SimdTarget limitedTarget(SimdTarget has, const char* limit);

// Returns what Auto becomes here; another target as it is. Throws Error when the processor does not have it
// or STEREONAV_SIMD hides it.
SimdTarget availableTarget(SimdTarget target);

// All sets that may be used here, narrowest first; Plain is always one.
std::vector<SimdTarget> simdTargets();

// Returns the kernels of the set that availableTarget() gives, and throws as it does; STEREONAV_EACH_SET
// (kernel_sets.h) declares them.
template <typename Kernels>
const Kernels& kernelsOf(SimdTarget target, const Kernels& plain, const Kernels& avx2,
                         const Kernels& avx512) {
    const SimdTarget set = availableTarget(target);
    return set == SimdTarget::Avx512 ? avx512 : set == SimdTarget::Avx2 ? avx2 : plain;
}

}  // namespace stereonav
