// Lookups in a picture of the ground; terrain/read/gdal reads it.
#include "terrain/raster/ground_picture.h"

#include <algorithm>
#include <utility>

namespace stereonav {

GroundPicture::GroundPicture(Parts parts) : mParts(std::move(parts)) {}

GroundPicture::Sample GroundPicture::at(const glm::dvec2& pixel) const {
    const glm::dvec2 p = (pixel - mParts.origin) / mParts.shrink;
    Sample sample;
    // A hair of slack: edges that coincide must not lose their last texel to rounding.
    if (!(p.x >= -0.01 && p.y >= -0.01 && p.x <= mParts.color.width() + 0.01 &&
          p.y <= mParts.color.height() + 0.01))
        return sample;
    const double x = std::clamp(p.x - 0.5, 0.0, mParts.color.width() - 1.0);
    const double y = std::clamp(p.y - 0.5, 0.0, mParts.color.height() - 1.0);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const float u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    bool whole = true;  // then covered whole, whatever rounding makes of the weights' sum
    for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a) {
            const float weight = (a ? u : 1 - u) * (b ? v : 1 - v);
            const int cx = std::min(i + a, mParts.color.width() - 1),
                      cy = std::min(j + b, mParts.color.height() - 1);
            if (!mParts.mask.empty() && mParts.mask.at(cx, cy) == 0) {
                whole = false;
                continue;
            }
            sample.color += weight * unpackColor(mParts.color.at(cx, cy));
            sample.cover += weight;
        }
    if (sample.cover > 0) sample.color /= sample.cover;
    if (whole) sample.cover = 1;
    return sample;
}

}  // namespace stereonav
