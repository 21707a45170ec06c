// How far rays may leap towards an isosurface, for every isovalue of a volume. For each rung of a ladder of
// values there is a field of blocks: the distance of each block to the nearest block with values at or above
// the rung, and which of that block's octants have such values. A field is valid for all isovalues from its
// rung up. It is built when first asked for and kept as long as this object; any thread may ask.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/base/lazy_array.h"
#include "engine/light/paths/path_kernel_types.h"
#include "engine/volume/volume.h"

namespace stereonav {

class IsovalueFields {
public:
    // Memory limit for all fields together. More rungs would let rays leap a little farther, but neighbouring
    // texels would share fewer fields: 256 rungs were a fifth slower than 64 on the engine.
    static constexpr std::size_t kBudget = std::size_t{256} << 20;
    static constexpr int kMostRungs = 64;
    // Range of isovalues that are asked for often, as stored numbers: they have rungs of their own. Values
    // above share the highest of these; values below share every kSharedRungs-th rung.
    struct Often {
        double lowest = -std::numeric_limits<double>::infinity();
        double highest = std::numeric_limits<double>::infinity();
    };
    static constexpr int kSharedRungs = 8;

    // leaping: false gives one field in which every octant has to be searched. Throws Error where memory is
    // too short for all fields that may be asked for.
    IsovalueFields(const GreyVolume& volume, bool leaping, std::size_t budget = kBudget)
        : IsovalueFields(volume, leaping, Often(), budget) {}
    IsovalueFields(const GreyVolume& volume, bool leaping, const Often& often, std::size_t budget = kBudget);

    int rungs() const { return static_cast<int>(mRungs.size()); }
    // Returns a rung whose field is valid for this isovalue: the highest one among those asked for often.
    int rungOf(double isovalue) const;
    double valueOf(int rung) const { return mRungs[rung]; }  // stored numbers
    // Returns the field of a rung, or all of them; that of a rung begins at block offset(rung).
    PathField field(int rung) const;
    PathField all() const { return fieldAt(0); }
    std::int32_t offset(int rung) const;
    std::size_t bytesHeld() const;        // bytes of the fields built so far
    std::size_t bytesToCome() const;      // bytes of the fields that may still be built
    int shift() const { return mShift; }  // blocks have 2^shift cells a side

private:
    struct Entry {
        std::once_flag once;
        std::atomic<bool> built = false;
    };
    PathField fieldAt(std::size_t firstBlock) const;
    void chooseRungs(int most);
    int highestRungFor(double isovalue) const;
    int rungsInUse() const;
    void build(int rung, std::uint8_t* blocks) const;
    std::size_t blockCount() const { return static_cast<std::size_t>(mBlocks.x) * mBlocks.y * mBlocks.z; }

    const GreyVolume& mVolume;
    bool mLeaping;
    int mShift = 1;  // blocks of 2^shift cells a side
    glm::ivec3 mBlocks{0};
    int mLowestOften = 0, mHighestOften = 0;  // rungs
    std::vector<int> mRungs;                  // ascending
    LazyArray<std::int16_t> mOctants;         // largest values, eight per block
    std::unique_ptr<Entry[]> mEntries;
    // One after the other; each is written once by the first thread that asks for it.
    mutable LazyArray<std::uint8_t> mFields;
};

}  // namespace stereonav
