// See the header. What counts as occupied is all that reaches the rung, inside included, so that a ray that
// rounding has carried below a surface is stopped at once.
#include "engine/light/isovalue_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace stereonav {
namespace {

constexpr int kLargestShift = 3;
constexpr int kWantedRungs = 64;  // larger blocks where the budget gives fewer
constexpr int kFarthest = 255;    // blocks

glm::ivec3 blocksFor(const glm::ivec3& cells, int shift) {
    return (cells + ((1 << shift) - 1)) >> glm::ivec3(shift);
}

// One octant row's flags, from the voxels around it.
class OctantRow {
public:
    OctantRow(const GreyVolume& volume, int rung, int side)
        : mVolume(volume), mRung(rung), mSide(side), mAny(static_cast<std::size_t>(volume.frame.size.x)) {}

    // Octants (.., y, z): flags of `count` octants; those beyond the volume are 0.
    void find(int y, int z, int count, std::uint8_t* flags) {
        const glm::ivec3 size = mVolume.frame.size;
        std::fill(flags, flags + count, std::uint8_t{0});
        if (y * mSide >= size.y - 1 || z * mSide >= size.z - 1) return;
        std::fill(mAny.begin(), mAny.end(), std::uint8_t{0});
        for (int k = z * mSide; k <= std::min((z + 1) * mSide, size.z - 1); ++k)
            for (int j = y * mSide; j <= std::min((y + 1) * mSide, size.y - 1); ++j) addRow(j, k);
        for (int x = 0; x < count; ++x)
            for (int i = x * mSide; i <= std::min((x + 1) * mSide, size.x - 1); ++i) flags[x] |= mAny[i];
        // The last voxel alone makes no cell.
        for (int x = (size.x - 2) / mSide + 1; x < count; ++x) flags[x] = 0;
    }

private:
    void addRow(int j, int k) {
        const std::int16_t* row = mVolume.values.data() + mVolume.frame.index(0, j, k);
        std::uint8_t* any = mAny.data();
        for (int i = 0; i < mVolume.frame.size.x; ++i) any[i] |= row[i] >= mRung ? 1 : 0;
    }

    const GreyVolume& mVolume;
    int mRung, mSide;
    std::vector<std::uint8_t> mAny;
};

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
                take(r, {r - mRow, r - mSlice - mRow, r - mSlice, r - mSlice + mRow});
                for (int x = 0; x < mBlocks.x; ++x) r[x] = nearer(r[x], r[x - 1]);
            }
        for (int z = mBlocks.z - 1; z >= 0; --z)
            for (int y = mBlocks.y - 1; y >= 0; --y) {
                std::uint8_t* r = row(y, z);
                take(r, {r + mRow, r + mSlice - mRow, r + mSlice, r + mSlice + mRow});
                for (int x = mBlocks.x - 1; x >= 0; --x) r[x] = nearer(r[x], r[x + 1]);
            }
    }

private:
    static std::uint8_t nearer(std::uint8_t own, std::uint8_t other) {
        return std::min(own, static_cast<std::uint8_t>(std::min<int>(other, kFarthest - 1) + 1));
    }
    void take(std::uint8_t* r, const std::uint8_t* const (&others)[4]) {
        std::uint8_t* least = mLeast.data() + 1;
        for (int x = -1; x <= mBlocks.x; ++x)
            least[x] = std::min(std::min(others[0][x], others[1][x]), std::min(others[2][x], others[3][x]));
        for (int x = 0; x < mBlocks.x; ++x)
            r[x] = nearer(r[x], std::min(least[x], std::min(least[x - 1], least[x + 1])));
    }
    void take(std::uint8_t* r, std::initializer_list<const std::uint8_t*> four) {
        const std::uint8_t* others[4];
        std::copy(four.begin(), four.end(), others);
        take(r, others);
    }

    glm::ivec3 mBlocks;
    std::size_t mRow, mSlice;
    std::vector<std::uint8_t> mValues, mLeast;
};

}  // namespace

IsovalueFields::IsovalueFields(const GreyVolume& volume, bool leaping, std::size_t budget)
    : mVolume(volume), mLeaping(leaping) {
    const glm::ivec3 cells = volume.frame.size - 1;
    mBlocks = blocksFor(cells, mShift);
    while (mShift < kLargestShift && budget / (2 * blockCount()) < kWantedRungs)
        mBlocks = blocksFor(cells, ++mShift);
    const auto fits = static_cast<int>(std::min<std::size_t>(budget / (2 * blockCount()), kMostRungs));
    chooseRungs(leaping ? std::max(fits, 2) : 1);
    mEntries = std::make_unique<Entry[]>(mRungs.size());
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

int IsovalueFields::rungOf(double isovalue) const {
    // Values are whole: those that reach the isovalue are at least its ceiling.
    const auto above = std::upper_bound(mRungs.begin(), mRungs.end(), std::ceil(isovalue));
    return std::max(static_cast<int>(above - mRungs.begin()) - 1, 0);
}

void IsovalueFields::build(int rung, LazyArray<std::uint8_t>& blocks) const {
    blocks = LazyArray<std::uint8_t>(2 * blockCount());
    if (!mLeaping) {
        for (std::size_t n = 0; n < blockCount(); ++n) blocks[2 * n + 1] = 255;
        return;
    }
    BlockDistances distances(mBlocks);
    OctantRow octants(mVolume, mRungs[rung], 1 << (mShift - 1));
    std::vector<std::uint8_t> flags(static_cast<std::size_t>(mBlocks.x) * 2);
    for (int z = 0; z < mBlocks.z; ++z)
        for (int y = 0; y < mBlocks.y; ++y) {
            std::uint8_t* out = &blocks[2 * ((static_cast<std::size_t>(z) * mBlocks.y + y) * mBlocks.x)];
            for (int part = 0; part < 4; ++part) {
                octants.find(2 * y + (part & 1), 2 * z + (part >> 1), 2 * mBlocks.x, flags.data());
                for (int x = 0; x < mBlocks.x; ++x)
                    out[2 * x + 1] |=
                        static_cast<std::uint8_t>((flags[2 * x] | flags[2 * x + 1] << 1) << (2 * part));
            }
            std::uint8_t* away = distances.row(y, z);
            for (int x = 0; x < mBlocks.x; ++x)
                if (out[2 * x + 1]) away[x] = 0;
        }
    distances.spread();
    for (int z = 0; z < mBlocks.z; ++z)
        for (int y = 0; y < mBlocks.y; ++y) {
            std::uint8_t* out = &blocks[2 * ((static_cast<std::size_t>(z) * mBlocks.y + y) * mBlocks.x)];
            const std::uint8_t* away = distances.row(y, z);
            for (int x = 0; x < mBlocks.x; ++x) out[2 * x] = away[x];
        }
}

PathField IsovalueFields::field(int rung) const {
    Entry& entry = mEntries[rung];
    std::call_once(entry.once, [&] {
        build(rung, entry.blocks);
        entry.built = true;
    });
    PathField field;
    field.blocks = entry.blocks.data();
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

}  // namespace stereonav
