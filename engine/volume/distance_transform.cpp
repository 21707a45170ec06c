// Exact distances in three passes within the mask's bounding box: runs along i give squared distances;
// planes along i and j, then along i and k, are combined line by line (distance_kernel.cpp), and the last
// pass writes units. Squares are held for a block of lines along j at a time.
#include "engine/volume/distance_transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/pages.h"
#include "engine/base/parallel.h"
#include "engine/simd/kernel_sets.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/distance_kernel_types.h"

namespace stereonav {

STEREONAV_EACH_SET(void combineDistances(const DistancePlane& plane, float* to, std::ptrdiff_t stride);
                   void finishDistances(const DistancePlane& plane, const DistanceUnits& units,
                                        std::uint16_t* to, std::ptrdiff_t stride, int width);)

namespace {

DistanceKernels distanceKernels(SimdTarget target) {
    return kernelsOf<DistanceKernels>(target, {plain::combineDistances, plain::finishDistances},
                                      {avx2::combineDistances, avx2::finishDistances},
                                      {avx512::combineDistances, avx512::finishDistances});
}

// A half-open range of indices; empty ranges join as nothing.
struct Range {
    int begin = 0, end = 0;
    bool empty() const { return begin >= end; }
    int size() const { return end - begin; }
    void join(const Range& other) {
        if (other.empty()) return;
        *this = empty() ? other : Range{std::min(begin, other.begin), std::max(end, other.end)};
    }
};

// The first index from `i` on where the row is set (or, with `set` false, is not); count if none.
int findNext(const std::uint8_t* row, int i, int count, bool set) {
    for (; i + 8 <= count; i += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, row + i, 8);
        // Zero bytes show as 0x80, without carries between bytes.
        constexpr std::uint64_t kLow = 0x7f7f7f7f7f7f7f7full;
        const std::uint64_t zeros = ~(((eight & kLow) + kLow) | eight | kLow);
        if (set ? eight != 0 : zeros != 0) break;
    }
    while (i < count && (row[i] != 0) != set) ++i;
    return i;
}

Range rangeOf(const std::uint8_t* row, int count) {
    const int begin = findNext(row, 0, count, true);
    if (begin == count) return {};
    int end = count;
    while (row[end - 1] == 0) --end;
    return {begin, end};
}

class Transform {
public:
    Transform(const MaskVolume& mask, bool outsideIsSeed, double unit, double atMost, SimdTarget target)
        : mMask(mask),
          mOutsideIsSeed(outsideIsSeed),
          mUnit(unit),
          mAtMost(atMost),
          mKernels(distanceKernels(target)) {}

    DistanceVolume run() {
        DistanceVolume result;
        static_cast<Volume<std::uint16_t>&>(result) = Volume<std::uint16_t>(mMask.frame);
        result.unit = mUnit;
        findRanges();
        if (mBox[0].empty()) return result;
        const glm::dvec3 spacing = mMask.frame.spacing;
        mSmallest = std::min({spacing.x, spacing.y, spacing.z});
        for (int axis = 0; axis < 3; ++axis) {
            const double ratio = spacing[axis] / mSmallest;
            mWeight[axis] = static_cast<float>(ratio * ratio);
        }
        const double most = mAtMost / mSmallest;
        mMostSquared = static_cast<float>(most * most);
        // Chunks begin at the box; the rows of squares have room for the last one.
        mStride = (mBox[0].size() + kDistanceChunk - 1) / kDistanceChunk * kDistanceChunk;
        const int lines = linesAtOnce();
        for (int j = mBox[1].begin; j < mBox[1].end; j += lines)
            measureLines({j, std::min(j + lines, mBox[1].end)}, result);
        return result;
    }

private:
    // All passes for some lines of every plane.
    void measureLines(const Range& block, DistanceVolume& result) {
        mBlock = block;
        mSquares = {};  // before the next ones, which begin as zeros
        mSquares = LazyArray<float>(static_cast<std::size_t>(mStride) * block.size() * mBox[2].size());
        mSquares.preferLargePages();
        parallelFor(mBox[2].size(), [&](int k) { firstTwoPasses(mBox[2].begin + k); });
        parallelFor(block.size(), [&](int j) { lastPass(block.begin + j, result); });
    }

    // Lines of squares that are held at once: of large masks a part of all.
    int linesAtOnce() const {
        constexpr std::size_t kSquares = std::size_t{1} << 24, kFewest = 64;
        const std::size_t perLine = static_cast<std::size_t>(mStride) * mBox[2].size();
        return static_cast<int>(
            std::min(std::max(kSquares / perLine, kFewest), static_cast<std::size_t>(mBox[1].size())));
    }

    Range& rowRange(int j, int k) {
        return mRows[static_cast<std::size_t>(k) * mMask.frame.size.y + static_cast<std::size_t>(j)];
    }

    void findRanges() {
        const glm::ivec3 size = mMask.frame.size;
        mRows.resize(static_cast<std::size_t>(size.y) * size.z);
        parallelFor(size.z, [&](int k) {
            for (int j = 0; j < size.y; ++j)
                rowRange(j, k) = rangeOf(mMask.values.data() + mMask.frame.index(0, j, k), size.x);
            releaseZeroPages(mMask.values, mMask.frame.index(0, 0, k),
                             static_cast<std::size_t>(size.x) * size.y);
        });
        for (int k = 0; k < size.z; ++k)
            for (int j = 0; j < size.y; ++j) {
                if (rowRange(j, k).empty()) continue;
                mBox[0].join(rowRange(j, k));
                mBox[1].join({j, j + 1});
                mBox[2].join({k, k + 1});
            }
    }

    // Returns whether what lies next to the first voxel of a range, or to the last, is a seed: always unless
    // it is beyond the volume.
    bool seedsBelow(const Range& range) const { return mOutsideIsSeed || range.begin > 0; }
    bool seedsAbove(const Range& range, int axis) const {
        return mOutsideIsSeed || range.end < mMask.frame.size[axis];
    }

    float* squares(int j, int k) {
        return mSquares.data() +
               (static_cast<std::size_t>(k - mBox[2].begin) * mBlock.size() + (j - mBlock.begin)) * mStride;
    }

    // Chunks that cover a range of columns, as columns from the box's begin.
    Range chunksOf(const Range& columns) const {
        const int begin = (columns.begin - mBox[0].begin) / kDistanceChunk * kDistanceChunk;
        const int end = columns.end - mBox[0].begin;
        return {begin, (end + kDistanceChunk - 1) / kDistanceChunk * kDistanceChunk};
    }

    // Squared distances to the ends of each run of set voxels, from column `first` on; gives the largest.
    float measureRuns(int j, int k, int first, float* to) {
        const int count = mMask.frame.size.x;
        const std::uint8_t* row = mMask.values.data() + mMask.frame.index(0, j, k);
        float *out = to - first, largest = 0;
        for (int begin = rowRange(j, k).begin; begin < count;) {
            const int end = findNext(row, begin, count, false);
            const bool low = mOutsideIsSeed || begin > 0, high = mOutsideIsSeed || end < count;
            constexpr float kFar = std::numeric_limits<float>::infinity();
            for (int i = begin; i < end; ++i) {
                const float left = low ? static_cast<float>(i - begin + 1) : kFar;
                const float right = high ? static_cast<float>(end - i) : kFar;
                const float least = std::min(left, right);
                out[i] = std::min(least * least * mWeight[0], mMostSquared);
                largest = std::max(largest, out[i]);
            }
            begin = findNext(row, end, count, true);
        }
        return largest;
    }

    // Rows that hold something, and the columns where.
    struct Extent {
        Range columns, lines;
    };
    Extent extentOf(int k, const Range& within) {
        Extent extent;
        for (int j = within.begin; j < within.end; ++j) {
            if (rowRange(j, k).empty()) continue;
            extent.columns.join(rowRange(j, k));
            extent.lines.join({j, j + 1});
        }
        return extent;
    }

    // Lines around the block's that may be nearer to something of it than what lies in its own rows.
    Range linesAround(const Range& own, const Range& all, float largest) const {
        const double reach = std::ceil(std::sqrt(static_cast<double>(largest / mWeight[1])));
        const int most = reach < all.size() ? static_cast<int>(reach) : all.size();
        return {std::max(own.begin - most, all.begin), std::min(own.end + most, all.end)};
    }

    void firstTwoPasses(int k) {
        const Extent all = extentOf(k, mBox[1]);
        const Range own = extentOf(k, mBlock).lines;
        if (own.empty()) return;
        const Range chunks = chunksOf(all.columns);
        const int first = mBox[0].begin + chunks.begin;
        const auto width = static_cast<std::size_t>(chunks.size());
        float largest = 0;
        const auto measure = [&](int j, std::vector<float>& rows, int line) {
            if (rowRange(j, k).empty()) return;
            const float most = measureRuns(j, k, first, rows.data() + width * static_cast<std::size_t>(line));
            largest = std::max(largest, most);
        };
        std::vector<float> ownRows(width * static_cast<std::size_t>(own.size()), 0.0f);
        for (int j = own.begin; j < own.end; ++j) measure(j, ownRows, j - own.begin);
        const Range lines = linesAround(own, all.lines, largest);
        std::vector<float> rows(width * static_cast<std::size_t>(lines.size()), 0.0f);
        std::copy(ownRows.begin(), ownRows.end(),
                  rows.begin() + static_cast<std::ptrdiff_t>(width) * (own.begin - lines.begin));
        for (int j = lines.begin; j < own.begin; ++j) measure(j, rows, j - lines.begin);
        for (int j = own.end; j < lines.end; ++j) measure(j, rows, j - lines.begin);
        const DistancePlane plane{rows.data(),
                                  lines.size(),
                                  own.begin - lines.begin,
                                  own.end - lines.begin,
                                  chunks.size(),
                                  mWeight[1],
                                  lines.begin == all.lines.begin && seedsBelow(lines),
                                  lines.end == all.lines.end && seedsAbove(lines, 1)};
        mKernels.combine(plane, squares(own.begin, k) + chunks.begin, mStride);
    }

    void lastPass(int j, DistanceVolume& result) {
        Range columns, lines;
        for (int k = mBox[2].begin; k < mBox[2].end; ++k) {
            if (rowRange(j, k).empty()) continue;
            columns.join(rowRange(j, k));
            lines.join({k, k + 1});
        }
        if (lines.empty()) return;
        const Range chunks = chunksOf(columns);
        std::vector<float> copy;
        copy.reserve(static_cast<std::size_t>(lines.size()) * chunks.size());
        for (int k = lines.begin; k < lines.end; ++k) appendLine(copy, j, k, chunks);
        const DistancePlane plane{copy.data(),       lines.size(),        0,
                                  lines.size(),      chunks.size(),       mWeight[2],
                                  seedsBelow(lines), seedsAbove(lines, 2)};
        const int first = mBox[0].begin + chunks.begin;
        const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(mMask.frame.size.x) * mMask.frame.size.y;
        mKernels.finish(plane, units(), result.values.data() + result.frame.index(first, j, lines.begin),
                        stride, columns.end - first);
    }

    // Rows without a set voxel are zeros that were never written.
    void appendLine(std::vector<float>& copy, int j, int k, const Range& chunks) {
        if (rowRange(j, k).empty()) {
            copy.resize(copy.size() + chunks.size(), 0.0f);
        } else {
            const float* row = squares(j, k);
            copy.insert(copy.end(), row + chunks.begin, row + chunks.end);
        }
    }

    // Squares are of lengths in the smallest spacing. With even spacing they are whole numbers; else each
    // of their weight, product and two sums may be off by 2^-24.
    DistanceUnits units() const {
        const bool whole = mWeight[0] == 1 && mWeight[1] == 1 && mWeight[2] == 1;
        const glm::dvec3 extent(mBox[0].size() + 1, mBox[1].size() + 1, mBox[2].size() + 1);
        const bool exact =
            whole && extent.x * extent.x + extent.y * extent.y + extent.z * extent.z < 16777216.0;
        const double unit = mUnit / mSmallest;
        return {static_cast<float>(1 / unit), unit * unit, exact ? 1.0 : 1 - 1.0 / 4194304};
    }

    const MaskVolume& mMask;
    bool mOutsideIsSeed;
    double mUnit, mAtMost, mSmallest = 1;
    float mMostSquared = 0;  // in smallest spacings
    DistanceKernels mKernels;
    std::vector<Range> mRows;  // columns of set voxels, by row
    Range mBox[3];             // range of set voxels, by axis
    float mWeight[3] = {1, 1, 1};
    int mStride = 0;
    Range mBlock;               // lines of the box
    LazyArray<float> mSquares;  // squared distances of those lines
};

}  // namespace

DistanceVolume distanceToOutside(const MaskVolume& mask, bool outsideIsSeed, double unit, SimdTarget target,
                                 double atMost) {
    const glm::dvec3 spacing = mask.frame.spacing;
    const double smallest = std::min({spacing.x, spacing.y, spacing.z});
    if (unit == 0) unit = smallest / 64;
    if (!(unit > 0 && std::isfinite(unit) && smallest > 0))
        throw Error("", "distance transform",
                    fmt::format("expected a unit and spacings above 0, got {} and {} m", unit, smallest),
                    "check the volume's spacing");
    if (!(atMost > 0))
        throw Error("", "distance transform", fmt::format("expected a distance above 0, got {} m", atMost),
                    "leave it out for all distances");
    return Transform(mask, outsideIsSeed, unit, atMost, target).run();
}

}  // namespace stereonav
