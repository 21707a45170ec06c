// Which of the kernels that are compiled for several instruction sets is run.
#pragma once

#include <array>
#include <string_view>

namespace stereonav {

// Auto takes the widest this processor has.
enum class SimdTarget { Auto, Plain, Avx2, Avx512 };

struct NamedSimdTarget {
    std::string_view name;
    SimdTarget target;
};
constexpr std::array<NamedSimdTarget, 4> kSimdTargets{{{"auto", SimdTarget::Auto},
                                                       {"plain", SimdTarget::Plain},
                                                       {"avx2", SimdTarget::Avx2},
                                                       {"avx512", SimdTarget::Avx512}}};

// What Auto becomes here; another target as it is. Throws Error when this processor does not have it.
SimdTarget availableTarget(SimdTarget target);

}  // namespace stereonav
