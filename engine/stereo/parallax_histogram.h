// Where all of a picture lies before and behind the screen, to the last pixel: a thin near thing is as hard
// on the eyes as a wide one.
#pragma once

#include <array>
#include <cstdint>

#include "engine/camera/stereo_rig.h"
#include "engine/image/plane.h"
#include "engine/simd/simd_target.h"
#include "engine/stereo/parallax_row.h"
#include "engine/stereo/room_seen.h"

namespace stereonav {

// Pixels by their parallax, a share of the picture's width; each counted where its parallax, computed in
// double precision, belongs. What is not hit is counted at the parallax of what is infinitely far.
struct ParallaxHistogram {
    static constexpr int kBins = kParallaxBins;
    static constexpr double kLowest = -0.06, kHighest = 0.08;  // shares of the picture's width
    // Returns where bin n begins, as a share of the picture's width; it reaches to the edge of the next. n:
    // up to kBins.
    static constexpr double lowerEdge(int n) { return kLowest + (kHighest - kLowest) * n / kBins; }

    std::array<std::int32_t, kBins> counts{};  // pixels in each bin
    std::int32_t below = 0, above = 0;         // nearer than the first bin, farther than the last
    std::int32_t unknown = 0;                  // holes and what is no depth: in none of the others

    std::int64_t known() const;                // all pixels that are counted
    double shareOf(std::int32_t count) const;  // share of known(), 0 to 1; 0 where there are none
    // Returns the share of known() that lies in a bin, 0 to 1.
    double share(int bin) const { return shareOf(counts[static_cast<std::size_t>(bin)]); }
};

// Parallax of a whole picture.
struct ParallaxSeen {
    double nearest = 0, farthest = 0;  // view depths, metres; 0 where nothing is known
    ParallaxRange range;               // parallax of these
    ParallaxHistogram histogram;
};

// Finds the parallax of every pixel of the left eye's depths, metres. The same for each instruction set and
// number of threads.
ParallaxSeen parallaxSeen(const StereoViews& views, const Plane<float>& viewDepth,
                          SimdTarget target = SimdTarget::Auto);

}  // namespace stereonav
