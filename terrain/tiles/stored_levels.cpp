#include "terrain/tiles/stored_levels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/hash.h"

namespace stereonav {
namespace {

// Scales a height with the same rounding as readDem(). Bounds have to include that rounding.
float scaledHeight(float height, double by) {
    return static_cast<float>(height * by);
}

}  // namespace

StoredLevels storedLevels(std::shared_ptr<const TileStore> store, const glm::dvec2& spacing,
                          double verticalScale) {
    // Rounding error as a share of a height, of both the level's and the ground's.
    constexpr double kRounding = 0x1p-23;
    StoredLevels levels;
    levels.size = store->size(0);
    levels.spacing = spacing;
    levels.low = scaledHeight(store->low(), verticalScale);
    levels.high = scaledHeight(store->high(), verticalScale);
    levels.content = Hash().add(static_cast<std::int64_t>(store->hash())).add(verticalScale).value();
    const double rounded =
        verticalScale == 1 ? 0 : kRounding * std::max(std::abs(levels.low), std::abs(levels.high));
    for (int level = 0; level < store->levels(); ++level) {
        std::vector<float> bounds = store->bounds(level);
        if (level > 0 && verticalScale != 1)
            for (float& bound : bounds)
                bound = static_cast<float>((bound * verticalScale + rounded) * (1 + 0x1p-22));
        levels.bounds.push_back(std::move(bounds));
    }
    levels.read = [store = std::move(store), verticalScale](int level, const glm::ivec2& low,
                                                            const glm::ivec2& size, float* heights) {
        store->read(level, low, size, heights);
        if (verticalScale == 1) return;
        const std::size_t count = static_cast<std::size_t>(size.x) * size.y;
        for (std::size_t n = 0; n < count; ++n) heights[n] = scaledHeight(heights[n], verticalScale);
    };
    return levels;
}

}  // namespace stereonav
