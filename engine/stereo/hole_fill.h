// Casts rays into the holes of a warped image: vertical bands of columns are the tasks, so that a scene
// can use the depth below in a column (Wan et al. 2004, section 3.3).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/image/plane.h"
#include "engine/render/eye_renderer.h"

namespace stereonav {

class HoleFill {
public:
    static constexpr int kBandWidth = 32;  // columns of a task: two vectors of sixteen

    // Casts every pixel whose mask is not 0 and gives their number. image.viewDepth is 0 there before.
    // Dynamic takes the bands in the order of decreasing number of holes, one at a time.
    long long fill(const EyeRenderer& renderer, const EyeView& view, const Plane<std::uint8_t>& mask,
                   Schedule schedule, EyeImage& image);

private:
    struct Band {
        int index;
        int holes;
    };
    void listBand(const Plane<std::uint8_t>& mask, int band);

    std::vector<PixelIndex> mPixels;  // kBandWidth * height for each band
    std::vector<Band> mBands;
};

}  // namespace stereonav
