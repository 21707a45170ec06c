// Maxima of a heightfield over blocks of 2^k x 2^k cells, by which a ray can leap over ground below it.
#pragma once

#include <array>
#include <vector>

#include "terrain/ground/heightfield.h"

namespace stereonav {

class HeightPyramid {
public:
    static constexpr int kMaxLevels = 16;

    HeightPyramid() = default;
    explicit HeightPyramid(const Heightfield& ground);

    int levelCount() const { return mLevels; }
    // Returns the largest height in block (i, j) of level k, metres; minus infinity where all its cells are
    // open.
    float at(int k, int i, int j) const {
        return mMaxima[mOffset[k] + static_cast<std::size_t>(j) * mPitch[k] + i];
    }
    const float* data() const { return mMaxima.data(); }
    // Index of block (0, 0) of each level in data(), and number of blocks in a row. Entries above
    // levelCount() repeat the last one.
    const std::array<std::int32_t, kMaxLevels>& offsets() const { return mOffset; }
    const std::array<std::int32_t, kMaxLevels>& pitches() const { return mPitch; }
    std::size_t byteCount() const { return mMaxima.size() * sizeof(float); }

private:
    int mLevels = 0;
    std::array<std::int32_t, kMaxLevels> mOffset{}, mPitch{};
    std::vector<float> mMaxima;  // metres
};

}  // namespace stereonav
