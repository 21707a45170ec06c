// The ground's colour: an image over the heightfield's extent with its mip levels, ready for
// bilinear lookup by the ray's footprint.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Levels halve (rounding up) down to 1 x 1, averaged in linear light. Texel (0, 0) of a level is
// south-west, as the heightfield's samples: x counts east, y counts north.
class ColorTexture {
public:
    ColorTexture() = default;
    // image: row 0 northernmost, as files have it. gridFromTexel: grid coordinates of the outer
    // corner of the south-west texel, and grid units a texel.
    ColorTexture(const Plane<PackedColor>& image, glm::dvec2 gridOrigin, glm::dvec2 gridPerTexel);

    int levelCount() const { return static_cast<int>(mLevels.size()); }
    const Plane<PackedColor>& level(int k) const { return mLevels[k]; }
    // Level-0 texel coordinates (continuous, centre of texel 0 at 0.5) = (grid - origin) / perTexel.
    glm::dvec2 gridOrigin() const { return mGridOrigin; }
    glm::dvec2 gridPerTexel() const { return mGridPerTexel; }
    std::size_t byteCount() const;

private:
    std::vector<Plane<PackedColor>> mLevels;
    glm::dvec2 mGridOrigin{0.0}, mGridPerTexel{1.0};
};

}  // namespace stereonav
