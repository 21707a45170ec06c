#include "engine/volume/leap_blocks.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "engine/base/pages.h"
#include "engine/base/parallel.h"
#include "engine/volume/cell_rows.h"
#include "engine/volume/distance_transform.h"

namespace stereonav {
namespace {

constexpr int kGroup = 4;        // cells along each side of a group
constexpr int kLeapBlock = 256;  // cells along each side of a block: whole bricks and groups
constexpr int kBrickSide = 16, kGroupsAcross = kBrickSide / kGroup;
// Codes while they are made: 0 is what was not written, and takes no memory. No code is as large as that of
// active cells; those of a region that are not active have one, until theirs is known.
constexpr std::uint8_t kActiveYet = kLargestCode, kInsideYet = kCellNear;
constexpr double kUnitShare = 4;  // distances are counted in quarters of the smallest spacing

glm::ivec3 groupsOf(const glm::ivec3& cells) {
    return (cells + (kGroup - 1)) / kGroup;
}

// 1 where neither the place nor one of those around it is set. setRow(j, k, row): flags of a row of `size.x`
// places and one beyond either end, for j and k from -1 to size.
template <typename SetRow>
MaskVolume awayFrom(const VolumeFrame& frame, const SetRow& setRow) {
    MaskVolume away(frame);
    const glm::ivec3 size = frame.size;
    parallelFor(size.z, [&](int k) {
        const std::size_t width = static_cast<std::size_t>(size.x) + 2;
        std::vector<std::uint8_t> row(width), lines(width * (static_cast<std::size_t>(size.y) + 2), 0);
        for (int j = -1; j <= size.y; ++j) {
            std::uint8_t* line = lines.data() + width * static_cast<std::size_t>(j + 1);
            for (int z = k - 1; z <= k + 1; ++z) {
                setRow(j, z, row.data());
                for (std::size_t i = 0; i < width; ++i) line[i] |= row[i];
            }
        }
        for (int j = 0; j < size.y; ++j) {
            const std::uint8_t* line = lines.data() + width * static_cast<std::size_t>(j);
            for (std::size_t i = 0; i < width; ++i) row[i] = line[i] | line[i + width] | line[i + 2 * width];
            std::uint8_t* out = away.values.data() + frame.index(0, j, k);
            for (int i = 0; i < size.x; ++i) out[i] = !(row[i] | row[i + 1] | row[i + 2]);
        }
    });
    return away;
}

class LeapBlocks {
public:
    LeapBlocks(const GreyVolume& volume, const SurfaceSetting& setting, SurfaceCells& cells)
        : mVolume(volume),
          mSetting(setting),
          mCells(cells),
          mFrame(cellFrameOf(volume.frame)),
          mGroups(groupsOf(mFrame.size)) {
        const glm::dvec3& s = mFrame.spacing;
        mSmallest = std::min({s.x, s.y, s.z});
        mUnit = mSmallest / kUnitShare;
    }

    void run(Progress& progress) {
        measureFar(flagAll());
        mDivisor = leapDivisor(std::max(largestFar(), reach()));
        mCells.leapUnit = mUnit * mDivisor;
        codeFarBricks();
        const glm::ivec3 blocks = (mFrame.size + (kLeapBlock - 1)) / kLeapBlock;
        const int count = blocks.x * blocks.y * blocks.z;
        constexpr const char* kMeasuring = "measuring distances to the surface";
        for (int n = 0; n < count; ++n) {
            progress.report(static_cast<double>(n) / count, kMeasuring);
            codeBlock(kLeapBlock *
                      glm::ivec3(n % blocks.x, n / blocks.x % blocks.y, n / (blocks.x * blocks.y)));
        }
        progress.report(1, kMeasuring);
    }

private:
    // Returns whether a cell ends leaps: it is active, or not in the region, where codes were not written.
    bool endsLeaps(std::uint8_t code) const {
        return code == kActiveYet || (code == 0 && mSetting.region != nullptr);
    }

    static int reach() { return static_cast<int>(kExactReach * kUnitShare); }  // units

    std::uint8_t* codesAt(int i, int j, int k) { return mCells.codes.data() + mCells.layout.index(i, j, k); }

    // Codes that tell what is active or in the region, where something is; the groups that hold what leaps
    // end at: what is active, and what is not in the region.
    MaskVolume flagAll() {
        mCells.codes = LazyArray<std::uint8_t>(mCells.layout.count());
        VolumeFrame frame = mFrame;
        frame.size = mGroups;
        frame.spacing *= static_cast<double>(kGroup);
        MaskVolume groups(frame);
        if (mSetting.region) mInside = MaskVolume(frame);
        const glm::ivec3 size = mFrame.size;
        parallelFor(mGroups.z, [&](int group) {
            std::vector<std::uint8_t> active(static_cast<std::size_t>(size.x)), inside(active.size(), 1);
            for (int k = group * kGroup; k < std::min((group + 1) * kGroup, size.z); ++k)
                for (int j = 0; j < size.y; ++j) {
                    std::uint8_t* of = &groups.at(0, j / kGroup, group);
                    if (mSetting.region && !flagRegion(*mSetting.region, j, k, size.x, inside.data())) {
                        std::fill_n(of, mGroups.x, std::uint8_t{1});
                        continue;
                    }
                    flagActive(mVolume, mSetting, j, k, size.x, inside.data(), active.data());
                    for (int i = 0; i < size.x; ++i) of[i / kGroup] |= active[i] | !inside[i];
                    if (mSetting.region) {
                        std::uint8_t* anyInside = &mInside.at(0, j / kGroup, group);
                        for (int i = 0; i < size.x; ++i) anyInside[i / kGroup] |= inside[i];
                    }
                    const std::uint8_t* written = mSetting.region ? inside.data() : active.data();
                    const std::uint8_t otherwise = mSetting.region ? kInsideYet : 0;
                    for (int first = 0; first < size.x; first += kBrickSide) {
                        const int end = std::min(first + kBrickSide, size.x);
                        if (!anySet(written + first, end - first)) continue;
                        std::uint8_t* codes = codesAt(first, j, k);
                        for (int i = first; i < end; ++i, ++codes)
                            if (written[i]) *codes = active[i] ? kActiveYet : otherwise;
                    }
                }
            if (mSetting.region) releaseSlices(*mSetting.region, group * kGroup, kGroup);
        });
        return groups;
    }

    // Most of a region's rows were only read.
    static void releaseSlices(const MaskVolume& region, int first, int count) {
        const std::size_t from = region.frame.index(0, 0, first),
                          end = region.frame.index(0, 0, std::min(first + count, region.frame.size.z));
        releaseZeroPages(region.values, from, end - from);
    }

    void measureFar(const MaskVolume& groups) {
        const auto setRow = [&](int j, int k, std::uint8_t* row) {
            std::fill_n(row, mGroups.x + 2, std::uint8_t{0});
            if (j < 0 || k < 0 || j >= mGroups.y || k >= mGroups.z) return;
            std::copy_n(groups.values.data() + groups.frame.index(0, j, k), mGroups.x, row + 1);
        };
        mFar = distanceToOutside(awayFrom(groups.frame, setRow), false, mUnit);
    }

    int largestFar() const {
        std::vector<int> largest(static_cast<std::size_t>(mGroups.z), 0);
        parallelFor(mGroups.z, [&](int k) {
            const std::uint16_t* far = mFar.values.data() + mFar.frame.index(0, 0, k);
            for (int n = 0; n < mGroups.x * mGroups.y; ++n)
                if (far[n] != DistanceVolume::kNoSeed) largest[k] = std::max<int>(largest[k], far[n]);
        });
        return *std::max_element(largest.begin(), largest.end());
    }

    std::uint8_t codeOf(int free, int largest) const {
        return static_cast<std::uint8_t>(std::min(1 + free / mDivisor, largest));
    }

    // Calls use(brick) for every one, on all threads.
    template <typename Use>
    void forBricks(const Use& use) const {
        const glm::ivec3 bricks = mCells.layout.bricks;
        parallelFor(bricks.z, [&](int k) {
            for (int j = 0; j < bricks.y; ++j)
                for (int i = 0; i < bricks.x; ++i) use(glm::ivec3(i, j, k));
        });
    }

    // Whether holds(i, j, k) of any group with a cell in the box.
    template <typename Holds>
    bool anyGroup(const glm::ivec3& first, const glm::ivec3& end, const Holds& holds) const {
        const glm::ivec3 low = first / kGroup, high = glm::min(groupsOf(end), mGroups);
        for (int k = low.z; k < high.z; ++k)
            for (int j = low.y; j < high.y; ++j)
                for (int i = low.x; i < high.x; ++i)
                    if (holds(i, j, k)) return true;
        return false;
    }

    // Returns whether something that ends leaps may be within the exact reach of the box.
    bool isNear(const glm::ivec3& first, const glm::ivec3& end) const {
        return anyGroup(first, end, [&](int i, int j, int k) { return mFar.at(i, j, k) < reach(); });
    }

    bool isInside(const glm::ivec3& first, const glm::ivec3& end) const {
        return !mSetting.region ||
               anyGroup(first, end, [&](int i, int j, int k) { return mInside.at(i, j, k) != 0; });
    }

    // Beyond the exact reach all cells of a group have one distance: bricks that lie there keep codes of
    // their groups alone.
    void codeFarBricks() {
        mCells.farCodes = LazyArray<std::uint8_t>(mCells.layout.count() >> 6);
        std::atomic<std::size_t> coded = 0;
        forBricks([&](const glm::ivec3& brick) {
            const glm::ivec3 first = brick * kBrickSide;
            if (isNear(first, first + kBrickSide)) {
                if (isInside(first, first + kBrickSide)) ++coded;
                return;
            }
            const glm::ivec3 low = brick * kGroupsAcross, high = glm::min(low + kGroupsAcross, mGroups);
            for (int k = low.z; k < high.z; ++k)
                for (int j = low.y; j < high.y; ++j)
                    for (int i = low.x; i < high.x; ++i)
                        mCells.farCodes[farIndexOf(kGroup * glm::ivec3(i, j, k))] =
                            codeOf(mFar.at(i, j, k), kLargestCode);
        });
        mCells.codedBricks = coded;
    }

    std::size_t farIndexOf(const glm::ivec3& cell) const {
        return BrickLayout::farIndex(mCells.layout.index(cell.x, cell.y, cell.z));
    }

    // Distances in the block, and as far around it as they reach: up to there they are exact.
    DistanceVolume measureNear(const glm::ivec3& low, const glm::ivec3& high) {
        const VolumeFrame frame = mFrame.cropped(low, high - low);
        const auto setRow = [&](int j, int k, std::uint8_t* row) {
            std::fill_n(row, frame.size.x + 2, std::uint8_t{0});
            const int y = low.y + j, z = low.z + k;
            if (y < 0 || z < 0 || y >= mFrame.size.y || z >= mFrame.size.z) return;
            const int end = std::min(high.x + 1, mFrame.size.x);
            for (int i = std::max(low.x - 1, 0); i < end;) {
                const std::uint8_t* codes = codesAt(i, y, z);
                const int stop = std::min((i | 15) + 1, end);
                for (std::uint8_t* out = row + (i - low.x + 1); i < stop; ++i) *out++ = endsLeaps(*codes++);
            }
        };
        return distanceToOutside(awayFrom(frame, setRow), false, mUnit, SimdTarget::Auto,
                                 kExactReach * mSmallest);
    }

    void codeBlock(const glm::ivec3& first) {
        const glm::ivec3 end = glm::min(first + kLeapBlock, mFrame.size);
        if (!isInside(first, end)) return;
        const glm::ivec3 around(glm::ceil(kExactReach * mSmallest / mFrame.spacing));
        const glm::ivec3 low = glm::max(first - around, 0), high = glm::min(end + around, mFrame.size);
        DistanceVolume near;
        if (isNear(first, end)) near = measureNear(low, high);
        parallelFor(end.z - first.z, [&](int slice) {
            const int k = first.z + slice;
            for (int j = first.y; j < end.y; ++j) {
                const std::uint16_t* far = mFar.values.data() + mFar.frame.index(0, j / kGroup, k / kGroup);
                const std::uint16_t* here =
                    near.empty() ? nullptr
                                 : near.values.data() + near.frame.index(0, j - low.y, k - low.z) - low.x;
                for (int i = first.x; i < end.x; ++i) {
                    if (i % kBrickSide == 0 && mCells.farCodes[farIndexOf({i, j, k})] != 0) {
                        i += kBrickSide - 1;
                        continue;
                    }
                    std::uint8_t& code = *codesAt(i, j, k);
                    if (endsLeaps(code)) continue;
                    const int free = std::max<int>(far[i / kGroup], here ? here[i] : reach());
                    code = codeOf(free, kActiveYet - 1);
                }
            }
        });
    }

    const GreyVolume& mVolume;
    const SurfaceSetting& mSetting;
    SurfaceCells& mCells;
    VolumeFrame mFrame;  // frame of the cells
    glm::ivec3 mGroups;
    double mSmallest = 1, mUnit = 1;  // metres
    DistanceVolume mFar;              // distances by group
    MaskVolume mInside;               // groups with a cell of the region, where there is one
    int mDivisor = 1;
};

}  // namespace

void codeLeapsByBlocks(const GreyVolume& volume, const SurfaceSetting& setting, Progress& progress,
                       SurfaceCells& cells) {
    LeapBlocks(volume, setting, cells).run(progress);
}

bool isMarkedActive(std::uint8_t code) {
    return code == kActiveYet;
}

void settleCodes(const SurfaceSetting& setting, SurfaceCells& cells) {
    const glm::ivec3 bricks = cells.layout.bricks;
    parallelFor(bricks.z, [&](int k) {
        const std::size_t layer = static_cast<std::size_t>(bricks.x) * bricks.y;
        for (std::size_t brick = layer * k; brick < layer * (k + 1); ++brick) {
            const std::size_t first = brick * kCellsOfBrick;
            if (cells.farCodes[BrickLayout::farIndex(first)] != 0) {
                if (!setting.region) continue;  // nothing was written
                std::fill_n(&cells.codes[first], kCellsOfBrick, std::uint8_t{0});
                cells.codes.release(first, kCellsOfBrick);
                continue;
            }
            std::uint8_t* codes = &cells.codes[first];
            for (std::size_t n = 0; n < kCellsOfBrick; ++n)
                if (codes[n] == kActiveYet) codes[n] = kCellActive;
        }
        // Codes outside a region were only read.
        if (setting.region) releaseZeroPages(cells.codes, layer * k * kCellsOfBrick, layer * kCellsOfBrick);
    });
}

}  // namespace stereonav
