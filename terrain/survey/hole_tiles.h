// Where a ground has samples that are not known, tile by tile: most of it has none.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/ground/heightfield.h"

namespace stereonav {

class HoleTiles {
public:
    explicit HoleTiles(const Heightfield& ground);

    // Returns whether any may be missing among the samples from `low` to `high`; beside the ground none is.
    bool any(const glm::ivec2& low, const glm::ivec2& high) const;

private:
    static constexpr int kSide = 16;  // samples

    int mWidth = 0, mHeight = 0;  // tiles; none: no holes
    std::vector<std::uint8_t> mHoles;
};

}  // namespace stereonav
