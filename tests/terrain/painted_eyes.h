// Eyes that are compared with what was painted on them.
#pragma once

#include <cmath>

#include "engine/image/eye_image.h"
#include "engine/image/packed_color.h"

namespace stereonav::test {

// Silhouettes, and crests that are about to be: where inverse depths, linear on planes, bend. x, y: two
// pixels from the border, or more.
inline bool bends(const Plane<float>& depth, int x, int y) {
    for (int j = y - 1; j <= y + 1; ++j)
        for (int i = x - 1; i <= x + 1; ++i) {
            const float here = 2 / depth.at(i, j);
            const float across = 1 / depth.at(i - 1, j) + 1 / depth.at(i + 1, j),
                        down = 1 / depth.at(i, j - 1) + 1 / depth.at(i, j + 1);
            if (!(std::abs(across - here) < 0.01f * here && std::abs(down - here) < 0.01f * here))
                return true;
        }
    return false;
}

// Returns the green channel as a byte, not rounded.
inline double greyAt(const EyeImage& image, int x, int y) {
    return 255.0 * srgbFromLinear(unpackColor(image.color.at(x, y)).y);
}

}  // namespace stereonav::test
