// See the header. What counts as occupied is all that reaches the rung, inside included, so that a ray that
// rounding has carried below a surface is stopped at once.
#include "engine/light/paths/isovalue_field.h"

#include <algorithm>
#include <cmath>

#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kLargestShift = 3;
constexpr int kWantedRungs = 48;  // larger blocks where the budget gives fewer
constexpr int kFarthest = 255;    // blocks

glm::ivec3 blocksFor(const glm::ivec3& cells, int shift) {
    return (cells + ((1 << shift) - 1)) >> glm::ivec3(shift);
}

// The largest value of each octant, the eight of a block together (x + 2 y + 4 z); below all values where an
// octant lies beyond the volume.
void findOctants(const GreyVolume& volume, const glm::ivec3& blocks, int side,
                 LazyArray<std::int16_t>& most) {
    const glm::ivec3 size = volume.frame.size;
    parallelFor(2 * blocks.z, [&](int z) {
        std::vector<std::int16_t> row(static_cast<std::size_t>(size.x));
        for (int y = 0; y < 2 * blocks.y; ++y) {
            std::int16_t* out = &most[8 * (static_cast<std::size_t>(z / 2) * blocks.y + y / 2) * blocks.x] +
                                (2 * (y & 1) + 4 * (z & 1));
            const bool beyond = y * side >= size.y - 1 || z * side >= size.z - 1;
            std::fill(row.begin(), row.end(), std::int16_t{-32768});
            for (int k = z * side; !beyond && k <= std::min((z + 1) * side, size.z - 1); ++k)
                for (int j = y * side; j <= std::min((y + 1) * side, size.y - 1); ++j) {
                    const std::int16_t* values = volume.values.data() + volume.frame.index(0, j, k);
                    for (int i = 0; i < size.x; ++i) row[i] = std::max(row[i], values[i]);
                }
            for (int x = 0; x < 2 * blocks.x; ++x) {
                std::int16_t& octant = out[8 * (x / 2) + (x & 1)] = -32768;
                if (x * side >= size.x - 1) continue;
                for (int i = x * side; i <= std::min((x + 1) * side, size.x - 1); ++i)
                    octant = std::max(octant, row[i]);
            }
        }
    });
}

// Distances by the largest difference along an axis, in two passes over the blocks (Rosenfeld and Pfaltz
// 1968, in three dimensions): exact for this metric. Between borders of kFarthest.
class BlockDistances {
public:
    explicit BlockDistances(const glm::ivec3& blocks)
        : mBlocks(blocks),
          mRow(static_cast<std::size_t>(blocks.x) + 2),
          mSlice(mRow * (static_cast<std::size_t>(blocks.y) + 2)),
          mValues(mSlice * (static_cast<std::size_t>(blocks.z) + 2), kFarthest),
          mLeast(mRow) {}

    std::uint8_t* row(int y, int z) {
        return &mValues[mSlice * static_cast<std::size_t>(z + 1) + mRow * static_cast<std::size_t>(y + 1) +
                        1];
    }
    void spread() {
        for (int z = 0; z < mBlocks.z; ++z)
            for (int y = 0; y < mBlocks.y; ++y) {
                std::uint8_t* r = row(y, z);
                take(r, r - mRow, r - mSlice - mRow, r - mSlice, r - mSlice + mRow);
                for (int x = 0; x < mBlocks.x; ++x) r[x] = nearer(r[x], r[x - 1]);
            }
        for (int z = mBlocks.z - 1; z >= 0; --z)
            for (int y = mBlocks.y - 1; y >= 0; --y) {
                std::uint8_t* r = row(y, z);
                take(r, r + mRow, r + mSlice - mRow, r + mSlice, r + mSlice + mRow);
                for (int x = mBlocks.x - 1; x >= 0; --x) r[x] = nearer(r[x], r[x + 1]);
            }
    }

private:
    static std::uint8_t nearer(std::uint8_t own, std::uint8_t other) {
        return std::min(own, static_cast<std::uint8_t>(other + (other < kFarthest ? 1 : 0)));
    }
    // One more than the least of four rows and their neighbours in x.
    void take(std::uint8_t* __restrict r, const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* c,
              const std::uint8_t* d) {
        std::uint8_t* __restrict least = mLeast.data() + 1;
        const int count = mBlocks.x;
        for (int x = -1; x <= count; ++x) least[x] = std::min(std::min(a[x], b[x]), std::min(c[x], d[x]));
        for (int x = 0; x < count; ++x)
            r[x] = nearer(r[x], std::min(least[x], std::min(least[x - 1], least[x + 1])));
    }

    glm::ivec3 mBlocks;
    std::size_t mRow, mSlice;
    std::vector<std::uint8_t> mValues, mLeast;
};

}  // namespace

IsovalueFields::IsovalueFields(const GreyVolume& volume, bool leaping, const Often& often, std::size_t budget)
    : mVolume(volume), mLeaping(leaping) {
    const glm::ivec3 cells = volume.frame.size - 1;
    mBlocks = blocksFor(cells, mShift);
    while (mShift < kLargestShift && budget / (2 * blockCount()) < kWantedRungs)
        mBlocks = blocksFor(cells, ++mShift);
    const auto fits = static_cast<int>(std::min<std::size_t>(budget / (2 * blockCount()), kMostRungs));
    chooseRungs(leaping ? std::max(fits, 2) : 1);
    mLowestOften = highestRungFor(often.lowest);
    mHighestOften = highestRungFor(often.highest);
    const std::size_t octants = leaping ? 8 * sizeof(std::int16_t) * blockCount() : 0;
    checkMemory("light along paths in a volume", static_cast<double>(octants + bytesToCome()),
                "crop the volume or make it coarser, or light fewer isovalues");
    if (leaping) {
        mOctants = LazyArray<std::int16_t>(8 * blockCount());
        findOctants(volume, mBlocks, 1 << (mShift - 1), mOctants);
    }
    mEntries = std::make_unique<Entry[]>(mRungs.size());
    mFields = LazyArray<std::uint8_t>(2 * blockCount() * mRungs.size());
}

// Every value above the least where there are few, else about as many voxels from each rung to the next.
void IsovalueFields::chooseRungs(int most) {
    std::vector<std::size_t> counts(65536, 0);
    const std::size_t voxels = mVolume.frame.count();
    for (std::size_t n = 0; n < voxels; ++n) ++counts[static_cast<std::size_t>(mVolume.values[n] + 32768)];
    const auto held = [](std::size_t c) { return c > 0; };
    const auto first = static_cast<int>(std::find_if(counts.begin(), counts.end(), held) - counts.begin());
    const auto last =
        static_cast<int>(counts.rend() - std::find_if(counts.rbegin(), counts.rend(), held)) - 1;
    mRungs.push_back(first + 1);  // see tracedIsovalue: nothing is traced at the least
    const std::size_t share = last - first <= most ? 0 : (voxels - counts[first]) / most + 1;
    std::size_t since = 0;
    for (int v = first + 2; v <= last && static_cast<int>(mRungs.size()) < most; ++v) {
        since += counts[v - 1];
        if (since < share) continue;
        mRungs.push_back(v);
        since = 0;
    }
    for (int& rung : mRungs) rung -= 32768;
}

int IsovalueFields::highestRungFor(double isovalue) const {
    // Values are whole: those that reach the isovalue are at least its ceiling.
    const auto above = std::upper_bound(mRungs.begin(), mRungs.end(), std::ceil(isovalue));
    return std::max(static_cast<int>(above - mRungs.begin()) - 1, 0);
}

// A field serves every isovalue from its rung on.
int IsovalueFields::rungOf(double isovalue) const {
    const int rung = highestRungFor(isovalue);
    if (rung < mLowestOften) return rung / kSharedRungs * kSharedRungs;
    return std::min(rung, mHighestOften);
}

int IsovalueFields::rungsInUse() const {
    return mHighestOften - mLowestOften + 1 + (mLowestOften + kSharedRungs - 1) / kSharedRungs;
}

void IsovalueFields::build(int rung, std::uint8_t* blocks) const {
    if (!mLeaping) {
        for (std::size_t n = 0; n < blockCount(); ++n) blocks[2 * n + 1] = 255;
        return;
    }
    BlockDistances distances(mBlocks);
    const auto least = static_cast<std::int16_t>(std::min(mRungs[rung], 32767));
    for (int z = 0; z < mBlocks.z; ++z)
        for (int y = 0; y < mBlocks.y; ++y) {
            const std::size_t first = (static_cast<std::size_t>(z) * mBlocks.y + y) * mBlocks.x;
            const std::int16_t* most = mOctants.data() + 8 * first;
            std::uint8_t *out = &blocks[2 * first], *away = distances.row(y, z);
            for (int x = 0; x < mBlocks.x; ++x) {
                int mask = 0;
                for (int n = 0; n < 8; ++n) mask |= (most[8 * x + n] >= least ? 1 : 0) << n;
                out[2 * x + 1] = static_cast<std::uint8_t>(mask);
                away[x] = mask ? 0 : kFarthest;
            }
        }
    distances.spread();
    for (int z = 0; z < mBlocks.z; ++z)
        for (int y = 0; y < mBlocks.y; ++y) {
            std::uint8_t* out = &blocks[2 * ((static_cast<std::size_t>(z) * mBlocks.y + y) * mBlocks.x)];
            const std::uint8_t* away = distances.row(y, z);
            for (std::ptrdiff_t x = 0; x < mBlocks.x; ++x) out[2 * x] = away[x];
        }
}

std::int32_t IsovalueFields::offset(int rung) const {
    const std::size_t first = blockCount() * static_cast<std::size_t>(rung);
    Entry& entry = mEntries[rung];
    std::call_once(entry.once, [&] {
        build(rung, mFields.data() + 2 * first);
        entry.built = true;
    });
    return static_cast<std::int32_t>(first);
}

PathField IsovalueFields::field(int rung) const {
    return fieldAt(static_cast<std::size_t>(offset(rung)));
}

PathField IsovalueFields::fieldAt(std::size_t firstBlock) const {
    PathField field;
    field.blocks = mFields.data() + 2 * firstBlock;
    field.across[0] = mBlocks.x;
    field.across[1] = mBlocks.y;
    field.shift = mShift;
    return field;
}

std::size_t IsovalueFields::bytesHeld() const {
    std::size_t built = 0;
    for (int n = 0; n < rungs(); ++n) built += mEntries[n].built;
    return built * 2 * blockCount();
}

std::size_t IsovalueFields::bytesToCome() const {
    const std::size_t all = 2 * blockCount() * static_cast<std::size_t>(rungsInUse());
    return all - (mEntries ? std::min(all, bytesHeld()) : 0);
}

}  // namespace stereonav
