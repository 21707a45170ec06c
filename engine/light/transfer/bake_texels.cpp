// Texel cells are tested against the range of the trilinear values in them: exactly where a texel cell lies
// within one voxel cell (the extremes are at its corners) or is made of whole ones (at the voxels), else by
// the voxels around, which is never too few.
#include "engine/light/transfer/bake_texels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kBrick = 8;

// Voxels around texels `first` to `last` along one axis.
struct VoxelSpan {
    int low, high;
    double begin, end;  // span of the texels, in voxels

    VoxelSpan(int first, int last, double voxelsPerTexel, int size)
        : begin(first * voxelsPerTexel), end(last * voxelsPerTexel) {
        constexpr double kRounding = 1e-6;
        low = std::clamp(static_cast<int>(std::floor(begin + kRounding)), 0, size - 1);
        high = std::clamp(static_cast<int>(std::ceil(end - kRounding)), 0, size - 1);
    }
    bool withinCell() const { return high - low <= 1; }
};

struct Range {
    double low = 1e300, high = -1e300;
    void add(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
};

// The range of the voxels low to high, ends included.
Range rangeOfVoxels(const GreyVolume& volume, const glm::ivec3& low, const glm::ivec3& high) {
    std::int16_t least = 32767, most = -32768;
    for (int k = low.z; k <= high.z; ++k)
        for (int j = low.y; j <= high.y; ++j) {
            const std::int16_t* row = volume.values.data() + volume.frame.index(0, j, k);
            for (int i = low.x; i <= high.x; ++i) {
                least = std::min(least, row[i]);
                most = std::max(most, row[i]);
            }
        }
    return {static_cast<double>(least), static_cast<double>(most)};
}

// The range of the trilinear values in a box within one voxel cell: at the box's corners.
Range rangeInCell(const GreyVolume& volume, const VoxelSpan spans[3]) {
    Range range;
    const auto share = [&](int axis, int corner) {
        const VoxelSpan& s = spans[axis];
        return std::clamp((corner ? s.end : s.begin) - s.low, 0.0, 1.0);
    };
    for (int n = 0; n < 8; ++n) {
        const double f[3] = {share(0, n & 1), share(1, n >> 1 & 1), share(2, n >> 2)};
        double value = 0;
        for (int m = 0; m < 8; ++m) {
            double weight = 1;
            for (int a = 0; a < 3; ++a) weight *= m >> a & 1 ? f[a] : 1 - f[a];
            value +=
                weight * volume.at(m & 1 ? spans[0].high : spans[0].low, m & 2 ? spans[1].high : spans[1].low,
                                   m & 4 ? spans[2].high : spans[2].low);
        }
        range.add(value);
    }
    return range;
}

bool anyInside(const MaskVolume& region, const glm::ivec3& low, const glm::ivec3& high) {
    for (int k = low.z; k <= high.z; ++k)
        for (int j = low.y; j <= high.y; ++j) {
            const std::uint8_t* row = region.values.data() + region.frame.index(0, j, k);
            for (int i = low.x; i <= high.x; ++i)
                if (row[i]) return true;
        }
    return false;
}

TexelMask wholeBrick(const glm::ivec3& first, const glm::ivec3& size) {
    TexelMask mask{};
    const glm::ivec3 count = glm::clamp(size - first, 0, kBrick);
    const std::uint64_t row = (1ull << count.x) - 1;
    for (int k = 0; k < count.z; ++k)
        for (int j = 0; j < count.y; ++j) mask[k] |= row << 8 * j;
    return mask;
}

}  // namespace

int countTexels(const TexelMask& mask) {
    int count = 0;
    for (const std::uint64_t word : mask) count += std::popcount(word);
    return count;
}

glm::ivec3 brickPlace(const TexelLayout& layout, std::uint32_t number) {
    const auto x = static_cast<std::uint32_t>(layout.bricks.x),
               y = static_cast<std::uint32_t>(layout.bricks.y);
    return {number % x, number / x % y, number / x / y};
}

std::vector<glm::ivec3> texelsIn(const TexelLayout& layout, const TexelBrick& brick) {
    const glm::ivec3 first = brickPlace(layout, brick.number) * kBrick;
    std::vector<glm::ivec3> texels;
    texels.reserve(static_cast<std::size_t>(countTexels(brick.wanted)));
    for (int k = 0; k < kBrick; ++k)
        for (std::uint64_t word = brick.wanted[k]; word != 0; word &= word - 1) {
            const int bit = std::countr_zero(word);
            texels.push_back(first + glm::ivec3(bit & 7, bit >> 3, k));
        }
    return texels;
}

TexelChooser::TexelChooser(const GreyVolume& volume, const VolumeFrame& texels, const TexelChoice& choice)
    : mVolume(volume),
      mTexels(texels),
      mLayout(texels.size),
      mChoice(choice),
      mVoxelsPerTexel(texels.spacing / volume.frame.spacing) {}

// Returns whether anything between voxels `low` and `high` counts; cells of one value hold no surface.
bool TexelChooser::mayHold(const glm::ivec3& low, const glm::ivec3& high) const {
    if (mChoice.region && !anyInside(*mChoice.region, low, high)) return false;
    const Range range = rangeOfVoxels(mVolume, low, high);
    return range.low < range.high && range.low <= mChoice.highest && range.high >= mChoice.lowest;
}

bool TexelChooser::crossed(const glm::ivec3& cell) const {
    const glm::ivec3 size = mVolume.frame.size;
    const VoxelSpan spans[3] = {{cell.x, cell.x + 1, mVoxelsPerTexel.x, size.x},
                                {cell.y, cell.y + 1, mVoxelsPerTexel.y, size.y},
                                {cell.z, cell.z + 1, mVoxelsPerTexel.z, size.z}};
    if (!mayHold({spans[0].low, spans[1].low, spans[2].low}, {spans[0].high, spans[1].high, spans[2].high}))
        return false;
    if (!spans[0].withinCell() || !spans[1].withinCell() || !spans[2].withinCell()) return true;
    const Range range = rangeInCell(mVolume, spans);
    // Corners are interpolated with rounding errors.
    constexpr double kRounding = 1e-6;
    return range.low <= mChoice.highest + kRounding && range.high >= mChoice.lowest - kRounding;
}

TexelMask TexelChooser::brick(std::uint32_t number) const {
    const glm::ivec3 first = brickPlace(mLayout, number) * kBrick, size = mTexels.size;
    if (mChoice.full) return wholeBrick(first, size);
    TexelMask mask{};
    // Cells with a corner in the brick; where there is one texel along an axis, it has one flat cell.
    const glm::ivec3 lastCell = glm::max(size - 2, 0);
    const glm::ivec3 low = glm::max(first - 1, 0), high = glm::min(first + kBrick - 1, lastCell);
    glm::ivec3 from, to;
    for (int a = 0; a < 3; ++a) {
        const VoxelSpan span(low[a], high[a] + 1, mVoxelsPerTexel[a], mVolume.frame.size[a]);
        from[a] = span.low;
        to[a] = span.high;
    }
    if (!mayHold(from, to)) return mask;
    const glm::ivec3 inBrick = glm::min(glm::ivec3(kBrick), size - first);
    glm::ivec3 cell;
    for (cell.z = low.z; cell.z <= high.z; ++cell.z)
        for (cell.y = low.y; cell.y <= high.y; ++cell.y)
            for (cell.x = low.x; cell.x <= high.x; ++cell.x) {
                if (!crossed(cell)) continue;
                for (int n = 0; n < 8; ++n) {
                    const glm::ivec3 t = cell - first + glm::ivec3(n & 1, n >> 1 & 1, n >> 2);
                    if (t.x >= 0 && t.y >= 0 && t.z >= 0 && t.x < inBrick.x && t.y < inBrick.y &&
                        t.z < inBrick.z)
                        mask[t.z] |= 1ull << (8 * t.y + t.x);
                }
            }
    return mask;
}

std::vector<TexelBrick> wantedBricks(const GreyVolume& volume, const VolumeFrame& texels,
                                     const TexelChoice& choice, Progress& progress) {
    const TexelChooser chooser(volume, texels, choice);
    const TexelLayout layout(texels.size);
    const int layer = layout.bricks.x * layout.bricks.y;
    std::vector<std::vector<TexelBrick>> found(static_cast<std::size_t>(layout.bricks.z));
    ProgressSteps layers(progress, layout.bricks.z, "choosing texels");
    parallelFor(layout.bricks.z, [&](int z) {
        if (progress.cancelled()) throw Cancelled();
        for (int n = z * layer; n < (z + 1) * layer; ++n) {
            const TexelBrick brick{static_cast<std::uint32_t>(n),
                                   chooser.brick(static_cast<std::uint32_t>(n))};
            if (countTexels(brick.wanted) > 0) found[z].push_back(brick);
        }
        layers.done();
    });
    std::vector<TexelBrick> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace stereonav
