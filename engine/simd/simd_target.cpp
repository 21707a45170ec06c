#include "engine/simd/simd_target.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "engine/base/error.h"

namespace stereonav {
namespace {

SimdTarget widestAllowed() {
    static const SimdTarget widest = limitedTarget(widestOfProcessor(), std::getenv("STEREONAV_SIMD"));
    return widest;
}

}  // namespace

std::string_view nameOf(SimdTarget target) {
    return kSimdTargets[static_cast<std::size_t>(target)].name;
}

SimdTarget widestOfProcessor() {
#if defined(__x86_64__)
    const bool hasAvx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool hasAvx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                           __builtin_cpu_supports("avx512cd");
    return hasAvx2 && hasAvx512 ? SimdTarget::Avx512 : hasAvx2 ? SimdTarget::Avx2 : SimdTarget::Plain;
#else
    return SimdTarget::Plain;
#endif
}

SimdTarget limitedTarget(SimdTarget has, const char* limit) {
    const std::string_view name = limit ? limit : "";
    if (name.empty()) return has;
    for (const NamedSimdTarget& known : kSimdTargets)
        if (known.target != SimdTarget::Auto && name == known.name) return std::min(has, known.target);
    throw Error("", "STEREONAV_SIMD", "expected plain, avx2 or avx512, got \"" + std::string(name) + "\"",
                "unset it, or name the widest instruction set to use");
}

SimdTarget availableTarget(SimdTarget target) {
    if (target == SimdTarget::Auto) return widestAllowed();
    if (target > widestOfProcessor())
        throw Error("", "--simd", "this processor does not have " + std::string(nameOf(target)), "use auto");
    if (target > widestAllowed())
        throw Error("", "--simd",
                    std::string(nameOf(target)) + " is hidden by the environment variable STEREONAV_SIMD",
                    "use auto, or unset it");
    return target;
}

std::vector<SimdTarget> simdTargets() {
    std::vector<SimdTarget> targets;
    for (const NamedSimdTarget& known : kSimdTargets)
        if (known.target != SimdTarget::Auto && known.target <= widestAllowed())
            targets.push_back(known.target);
    return targets;
}

}  // namespace stereonav
