// Plain loops that the compiler turns into vectors, once for each instruction set.
#include "engine/stereo/contrast_row.h"

namespace stereonav::STEREONAV_ISA {
namespace {

inline std::int32_t apart(std::uint32_t a, std::uint32_t b, int shift) {
    const auto d =
        static_cast<std::int32_t>(a >> shift & 1023u) - static_cast<std::int32_t>(b >> shift & 1023u);
    return d < 0 ? -d : d;
}

inline std::int32_t larger(std::int32_t a, std::int32_t b) {
    return a > b ? a : b;
}

inline std::int32_t contrast(std::uint32_t at, std::uint32_t beside, std::uint8_t hole) {
    const std::uint32_t other = hole ? at : beside;
    return larger(apart(at, other, 0), larger(apart(at, other, 10), apart(at, other, 20)));
}

// The exponent and two bits of the mantissa of the difference as a float; 1 is the first class above 0.
inline std::uint8_t classOf(std::int32_t difference) {
    constexpr std::int32_t kBelowOne = (127 << 2) - 1;
    const std::int32_t quarter = __builtin_bit_cast(std::int32_t, static_cast<float>(difference)) >> 21;
    return static_cast<std::uint8_t>(larger(quarter - kBelowOne, 0));
}

}  // namespace

// The pointers as values of their own, and the output apart from all else: or nothing would be vectorised.
void contrastRow(const ContrastRow& r) {
    const std::uint32_t* const above = r.above;
    const std::uint32_t* const row = r.row;
    const std::uint32_t* const below = r.below;
    const std::uint8_t* const holesAbove = r.holesAbove;
    const std::uint8_t* const holes = r.holes;
    const std::uint8_t* const holesBelow = r.holesBelow;
    std::uint8_t* const __restrict classes = r.classes;
    const int last = r.width - 1;
    const auto classAt = [=](int x, int left, int right) {
        const std::uint32_t at = row[x];
        const std::int32_t beside =
            larger(contrast(at, row[left], holes[left]), contrast(at, row[right], holes[right]));
        const std::int32_t across =
            larger(contrast(at, above[x], holesAbove[x]), contrast(at, below[x], holesBelow[x]));
        const std::uint8_t found = classOf(larger(beside, across));
        return holes[x] ? kNoContrast : found;
    };
    classes[0] = classAt(0, 0, last > 0 ? 1 : 0);
    for (int x = 1; x < last; ++x) classes[x] = classAt(x, x - 1, x + 1);
    if (last > 0) classes[last] = classAt(last, last - 1, last);
}

}  // namespace stereonav::STEREONAV_ISA
