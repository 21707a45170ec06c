// Least and most heights of a layer over blocks of its samples, coarser and coarser: where in the world the
// layer may be, whatever level of the mip a sample reads.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/medium/model/height_layer.h"

namespace stereonav {

class HeightBounds {
public:
    // displacement: metres that noise moves places by at most. The layer has heights; it is not kept.
    HeightBounds(const HeightLayer& layer, double displacement);
    // Returns false where no place in the box (world, low <= high) that is sampled with a footprint up to
    // this one, metres, is in the layer. Roundings of floats are allowed for; NaN asks for everything.
    bool meets(const glm::dvec3& low, const glm::dvec3& high, double footprint) const;
    std::size_t heldBytes() const;

private:
    struct Range {
        float low, high;  // low > high: nothing known
    };
    struct Level {
        int width = 0, height = 0;
        std::vector<Range> blocks;
    };
    double marginOf(double footprint) const;

    glm::dvec2 mOrigin{0.0};  // metres
    int mWidth = 0, mHeight = 0;
    double mSpacing = 1;               // metres between samples
    double mCoarsest = 1;              // samples a side of the coarsest level's blocks
    double mBelow = 0, mAbove = 0;     // metres: what of the layer is beside its heights, with roundings
    double mReach = 0;                 // metres sideways
    double mLowest = 0, mHighest = 0;  // metres, world z
    std::vector<Level> mLevels;        // blocks of 2, 4, 8 .. samples a side
};

}  // namespace stereonav
