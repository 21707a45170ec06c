// Least and largest heights of a layer over blocks of its samples, coarser and coarser: the part of the world
// where the layer may be, at any mip level that a sample reads.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/medium/model/height_layer.h"

namespace stereonav {

class HeightBounds {
public:
    // displacement: largest displacement by noise, metres. layer: has heights; not stored.
    HeightBounds(const HeightLayer& layer, double displacement);
    // Returns false where no place in the box (world, low <= high), sampled with a footprint up to this one
    // in metres, is in the layer. Allows for rounding of floats; NaN returns true.
    bool meets(const glm::dvec3& low, const glm::dvec3& high, double footprint) const;
    std::size_t heldBytes() const;

private:
    struct Range {
        float low, high;  // low > high: nothing is known
    };
    struct Level {
        int width = 0, height = 0;
        std::vector<Range> blocks;
    };
    double marginOf(double footprint) const;

    glm::dvec2 mOrigin{0.0};  // metres
    int mWidth = 0, mHeight = 0;
    double mSpacing = 1;   // metres between samples
    double mCoarsest = 1;  // samples per side of the coarsest level's blocks
    // Metres: extent of the layer below and above its heights, with allowance for rounding.
    double mBelow = 0, mAbove = 0;
    double mReach = 0;                 // metres sideways
    double mLowest = 0, mHighest = 0;  // metres, world z
    std::vector<Level> mLevels;        // blocks of 2, 4, 8 .. samples a side
};

}  // namespace stereonav
