// Finds missing samples of a ground quickly: stores for each tile whether it has any.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/ground/heightfield.h"

namespace stereonav {

class HoleTiles {
public:
    explicit HoleTiles(const Heightfield& ground);

    // Returns whether samples from `low` to `high` may be missing; samples outside the ground are not.
    bool any(const glm::ivec2& low, const glm::ivec2& high) const;

private:
    static constexpr int kSide = 16;  // samples

    int mWidth = 0, mHeight = 0;  // in tiles; 0: the ground has no holes
    std::vector<std::uint8_t> mHoles;
};

}  // namespace stereonav
