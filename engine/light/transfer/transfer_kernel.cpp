// Dot products of stored transfer with a light, kLanes texels side by side, for one instruction set (Wyman
// et al. 2006, eq. 9; Y4 of docs/ledger.md). Halves are taken apart with integer arithmetic: none of the
// kernels' instruction sets but the widest has conversions.
#include "engine/light/transfer/transfer_kernel_types.h"
#include "engine/simd/simd.h"

#if STEREONAV_ISA_avx512
// g++ 12 warns about its own undefined registers (gcc bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

namespace stereonav::STEREONAV_ISA {
namespace {

// Returns the half in the upper 16 bits of each word as a float that is 2^-112 times as large: its exponent
// bits land in a float's exponent, whose bias is larger by 112. Sums are scaled by 2^112 instead of each
// term: by 2^56 in TransferGroups::light, by 2^56 at the end.
STEREONAV_INLINE F upperHalf(I word) {
    return asFloat(shiftRight<3>(word) & I(static_cast<int>(0x8fffe000u)));
}

STEREONAV_INLINE I packHalf(F value) {
    const F v = min(max(value, F(0.0f)), F(65504.0f));
    const I bits = asInt(v);
    const I odd = shiftRight<13>(bits) & I(1);
    const I normal = shiftRight<13>(bits + odd + I(0xfff - (112 << 23)));
    const I tiny = asInt(v + F(0.5f)) - I(0x3f000000);
    return select(v < F(0x1p-14f), tiny, normal);
}

struct Sums {
    F red = F(0.0f), green = F(0.0f), blue = F(0.0f);
};

STEREONAV_INLINE Sums dotGrey(const std::uint32_t* words, int pairs, const float* light) {
    Sums s;
    for (int p = 0; p < pairs; ++p, words += kTransferGroup, light += 6) {
        const I word = loadI(words);
        const F low = upperHalf(shiftLeft<16>(word)), high = upperHalf(word);
        s.red = mulAdd(low, F(light[0]), mulAdd(high, F(light[3]), s.red));
        s.green = mulAdd(low, F(light[1]), mulAdd(high, F(light[4]), s.green));
        s.blue = mulAdd(low, F(light[2]), mulAdd(high, F(light[5]), s.blue));
    }
    return s;
}

STEREONAV_INLINE F dotChannel(const std::uint32_t* words, int pairs, const float* light) {
    F sum(0.0f);
    for (int p = 0; p < pairs; ++p, words += kTransferGroup, light += 6) {
        const I word = loadI(words);
        sum = mulAdd(upperHalf(shiftLeft<16>(word)), F(light[0]), mulAdd(upperHalf(word), F(light[3]), sum));
    }
    return sum;
}

STEREONAV_INLINE Sums dot(const TransferGroups& from, const std::uint32_t* words) {
    if (from.channels == 1) return dotGrey(words, from.pairs, from.light);
    const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(from.pairs) * kTransferGroup;
    Sums s;
    s.red = dotChannel(words, from.pairs, from.light);
    s.green = dotChannel(words + step, from.pairs, from.light + 1);
    s.blue = dotChannel(words + 2 * step, from.pairs, from.light + 2);
    return s;
}

}  // namespace

void relight(const TransferGroups& from, std::uint32_t* redGreen, std::uint32_t* blueWeight) {
    constexpr int kOne = 0x3c00;  // a half
    const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(from.channels) * from.pairs * kTransferGroup;
    for (int g = 0; g < from.groups; ++g)
        for (int lane = 0; lane < kTransferGroup; lane += kLanes) {
            const Sums s = dot(from, from.words + g * step + lane);
            const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(g) * kTransferGroup + lane;
            const F scale(kTransferLightScale);
            store(redGreen + to, packHalf(s.red * scale) | shiftLeft<16>(packHalf(s.green * scale)));
            store(blueWeight + to, packHalf(s.blue * scale) | I(kOne << 16));
        }
}

}  // namespace stereonav::STEREONAV_ISA
