// Arguments of the relighting kernels: plain numbers only, since they are compiled for several instruction
// sets.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stereonav {

// Texels in a group: the most lanes that a kernel has.
constexpr int kTransferGroup = 16;

// Half of the factor 2^112 that upperHalf() leaves out; applied twice.
constexpr float kTransferLightScale = 0x1p56f;

// Transfer of groups of texels: a group is channels * pairs rows of kTransferGroup words, one word per texel,
// with the halves of coefficients 2 p (low) and 2 p + 1 of a channel.
struct TransferGroups {
    const std::uint32_t* words = nullptr;
    int groups = 0, pairs = 0;
    int channels = 1;  // 1 or 3
    // Coefficients of the light, 2 * pairs times 3: red, green, blue of a coefficient, times
    // kTransferLightScale.
    const float* light = nullptr;
};

struct TransferKernels {
    // Writes the dot products as packed texels in two halves: red | green << 16, and blue | weight 1 << 16.
    void (*relight)(const TransferGroups& from, std::uint32_t* redGreen, std::uint32_t* blueWeight);
};

}  // namespace stereonav
