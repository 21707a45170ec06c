// Distribution of a picture's parallax before and behind the screen, over all pixels: a thin near object is
// as hard on the eyes as a wide one.
#pragma once

#include <array>
#include <cstdint>

#include "engine/camera/stereo_rig.h"
#include "engine/image/plane.h"
#include "engine/simd/simd_target.h"
#include "engine/stereo/parallax_row.h"
#include "engine/stereo/room_seen.h"

namespace stereonav {

// Numbers of pixels by their parallax, as a share of the picture's width. Each is counted in the bin of its
// parallax in double precision. Pixels that hit nothing have the parallax of infinitely far objects.
struct ParallaxHistogram {
    static constexpr int kBins = kParallaxBins;
    static constexpr double kLowest = -0.06, kHighest = 0.08;  // shares of the picture's width
    // Returns the lower edge of bin n, as a share of the picture's width; n = kBins gives the upper edge of
    // the last bin.
    static constexpr double lowerEdge(int n) { return kLowest + (kHighest - kLowest) * n / kBins; }

    std::array<std::int32_t, kBins> counts{};  // pixels in each bin
    std::int32_t below = 0, above = 0;         // nearer than the first bin, farther than the last
    std::int32_t unknown = 0;  // holes, and pixels without a valid depth; counted nowhere else

    std::int64_t known() const;                // number of pixels with a known parallax
    double shareOf(std::int32_t count) const;  // share of known(), 0 to 1; 0 where there are none
    // Returns the share of known() that lies in a bin, 0 to 1.
    double share(int bin) const { return shareOf(counts[static_cast<std::size_t>(bin)]); }
};

// The range of a whole picture's parallax.
struct ParallaxSeen {
    double nearest = 0, farthest = 0;  // view depths, metres; 0 where nothing is known
    ParallaxRange range;               // parallax of these depths
    ParallaxHistogram histogram;
};

// Finds the parallax of every pixel from the left eye's depths, metres. Results are the same for each
// instruction set and number of threads.
ParallaxSeen parallaxSeen(const StereoViews& views, const Plane<float>& viewDepth,
                          SimdTarget target = SimdTarget::Auto);

}  // namespace stereonav
