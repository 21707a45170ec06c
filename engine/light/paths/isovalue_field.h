// How far rays may leap towards an isosurface, for every isovalue of a volume: for a ladder of values a field
// of blocks, each with its distance to the nearest block that holds values at or above the rung, and which of
// its octants do. A field serves every isovalue from its rung on. Built when first asked for, kept while the
// ladder lives; any thread may ask.
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
    // Memory of all fields together, once all are built. More rungs would let rays leap a little further, but
    // neighbouring texels would share fewer fields: 256 rungs were a fifth slower than 64 on the engine.
    static constexpr std::size_t kBudget = std::size_t{256} << 20;
    static constexpr int kMostRungs = 64;
    // Isovalues that are asked for often, stored numbers. Others share rungs: those above the highest's,
    // those below every kSharedRungs-th.
    struct Often {
        double lowest = -std::numeric_limits<double>::infinity();
        double highest = std::numeric_limits<double>::infinity();
    };
    static constexpr int kSharedRungs = 8;

    // leaping: false gives one field in which every octant is to be looked at. Throws Error where there is no
    // memory for all fields that may be asked for.
    IsovalueFields(const GreyVolume& volume, bool leaping, std::size_t budget = kBudget)
        : IsovalueFields(volume, leaping, Often(), budget) {}
    IsovalueFields(const GreyVolume& volume, bool leaping, const Often& often, std::size_t budget = kBudget);

    int rungs() const { return static_cast<int>(mRungs.size()); }
    // Returns the number of a rung that is not above any value that reaches the isovalue: the highest such
    // among those often asked for.
    int rungOf(double isovalue) const;
    double valueOf(int rung) const { return mRungs[rung]; }  // stored numbers
    // The field of a rung alone, or all of them: that of a rung begins offset(rung) blocks on.
    PathField field(int rung) const;
    PathField all() const { return fieldAt(0); }
    std::int32_t offset(int rung) const;
    std::size_t bytesHeld() const;        // bytes of the fields built so far
    std::size_t bytesToCome() const;      // bytes of fields that rungOf() may still ask for
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
    LazyArray<std::int16_t> mOctants;         // largest values, eight a block
    std::unique_ptr<Entry[]> mEntries;
    mutable LazyArray<std::uint8_t> mFields;  // one after the other, each written once by whoever asks first
};

}  // namespace stereonav
