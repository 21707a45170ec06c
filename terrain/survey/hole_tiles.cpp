#include "terrain/survey/hole_tiles.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"

namespace stereonav {

HoleTiles::HoleTiles(const Heightfield& ground) {
    if (!ground.hasHoles()) return;
    mWidth = (ground.width() + kSide - 1) / kSide, mHeight = (ground.height() + kSide - 1) / kSide;
    mHoles.resize(static_cast<std::size_t>(mWidth) * mHeight);
    parallelFor(mHeight, [&](int tileRow) {
        std::uint8_t* const tiles = mHoles.data() + static_cast<std::size_t>(tileRow) * mWidth;
        const int end = std::min((tileRow + 1) * kSide, ground.height());
        for (int j = tileRow * kSide; j < end; ++j) {
            const float* const row = ground.data() + static_cast<std::size_t>(j) * ground.width();
            for (int tile = 0; tile < mWidth; ++tile) {
                unsigned holes = 0;
                for (int i = tile * kSide; i < std::min((tile + 1) * kSide, ground.width()); ++i)
                    holes |= std::isfinite(row[i]) ? 0u : 1u;
                if (holes != 0) tiles[tile] = 1;
            }
        }
    });
}

bool HoleTiles::any(const glm::ivec2& low, const glm::ivec2& high) const {
    if (mHoles.empty()) return false;
    const int left = std::max(0, low.x) / kSide, right = std::min(high.x / kSide, mWidth - 1);
    const int bottom = std::max(0, low.y) / kSide, top = std::min(high.y / kSide, mHeight - 1);
    for (int j = bottom; j <= top; ++j)
        for (int i = left; i <= right; ++i)
            if (mHoles[static_cast<std::size_t>(j) * mWidth + i] != 0) return true;
    return false;
}

}  // namespace stereonav
