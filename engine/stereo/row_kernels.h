// The vector kernels of the inverse warp, one for each instruction set, and the choice at run time.
#pragma once

#include <string_view>

#include "engine/stereo/warp_row.h"

namespace stereonav {

struct NamedResampler {
    std::string_view name;  // plain, avx2, avx512
    ResampleFunction function;
    bool supported;  // by this processor, and not hidden by STEREONAV_SIMD
};

// Narrowest first; the last supported one is the fastest.
struct Resamplers {
    NamedResampler plain, avx2, avx512;
};
Resamplers resamplers();
ResampleFunction fastestResampler();

}  // namespace stereonav
