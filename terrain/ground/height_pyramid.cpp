#include "terrain/ground/height_pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr float kOpen = -std::numeric_limits<float>::infinity();

float cellMaximum(const Heightfield& ground, int i, int j) {
    const float a = ground.sample(i, j), b = ground.sample(i + 1, j);
    const float c = ground.sample(i, j + 1), d = ground.sample(i + 1, j + 1);
    return std::isfinite(a + b + c + d) ? std::max({a, b, c, d}) : kOpen;
}

}  // namespace

HeightPyramid::HeightPyramid(const Heightfield& ground) {
    int width = ground.width() - 1, height = ground.height() - 1;
    std::array<int, kMaxLevels> rows{};
    std::size_t total = 0;
    for (mLevels = 0; mLevels < kMaxLevels; ++mLevels) {
        mOffset[mLevels] = static_cast<std::int32_t>(total);
        mPitch[mLevels] = width;
        rows[mLevels] = height;
        total += static_cast<std::size_t>(width) * height;
        if (width == 1 && height == 1) {
            ++mLevels;
            break;
        }
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    for (int k = mLevels; k < kMaxLevels; ++k)
        mOffset[k] = mOffset[mLevels - 1], mPitch[k] = mPitch[mLevels - 1];
    mMaxima.resize(total);
    parallelFor(rows[0], [&](int j) {
        for (int i = 0; i < mPitch[0]; ++i)
            mMaxima[static_cast<std::size_t>(j) * mPitch[0] + i] = cellMaximum(ground, i, j);
    });
    for (int k = 1; k < mLevels; ++k)
        parallelFor(rows[k], [&](int j) {
            for (int i = 0; i < mPitch[k]; ++i) {
                const int i1 = std::min(2 * i + 1, mPitch[k - 1] - 1),
                          j1 = std::min(2 * j + 1, rows[k - 1] - 1);
                mMaxima[mOffset[k] + static_cast<std::size_t>(j) * mPitch[k] + i] = std::max(
                    {at(k - 1, 2 * i, 2 * j), at(k - 1, i1, 2 * j), at(k - 1, 2 * i, j1), at(k - 1, i1, j1)});
            }
        });
}

}  // namespace stereonav
