// One colour over another one that is there already.
#pragma once

#include "engine/image/packed_color.h"

namespace stereonav {

// Returns a mixture of two colours. share: of `over`, 0 to 255. Mixed between packed values, whose steps look
// alike, in whole numbers.
inline PackedColor blended(PackedColor under, PackedColor over, unsigned share) {
    const auto channel = [&](unsigned shift) -> PackedColor {
        const unsigned below = under >> shift & 1023u, above = over >> shift & 1023u;
        return (below * (255u - share) + above * share + 127u) / 255u << shift;
    };
    return channel(0) | channel(10) | channel(20);
}

}  // namespace stereonav
