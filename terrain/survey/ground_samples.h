// The samples of a ground for measurements along lines and outlines: all in memory, or in tiles on disk that
// are read when they are needed.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <list>
#include <memory>
#include <mutex>
#include <vector>

#include "terrain/ground/ground_levels.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// Tiles of one level of a stored ground: the most recently used are kept, up to kMostBytes of them. From any
// thread.
class SurveyTiles {
public:
    static constexpr int kSide = 256;  // samples, as on disk
    static constexpr std::size_t kMostBytes = std::size_t(128) << 20;
    using Tile = std::vector<float>;  // metres, kSide * kSide, NaN where missing and beyond the ground

    explicit SurveyTiles(std::shared_ptr<const GroundLevels> levels, int level = 0,
                         std::size_t mostBytes = kMostBytes);

    const GroundLevels& levels() const { return *mLevels; }
    int level() const { return mLevel; }
    // Returns a tile by its column and row in the grid of tiles. Throws Error where it can not be read.
    std::shared_ptr<const Tile> tile(const glm::ivec2& number);

private:
    struct Kept {
        std::size_t place;  // index in mPlaces
        std::shared_ptr<const Tile> tile;
    };
    std::shared_ptr<const Tile> read(const glm::ivec2& number) const;

    const std::shared_ptr<const GroundLevels> mLevels;
    const int mLevel;
    const std::size_t mMost;  // tiles
    glm::ivec2 mTiles{0};
    std::mutex mMutex;
    std::list<Kept> mKept;                           // most recently used first
    std::vector<std::list<Kept>::iterator> mPlaces;  // by tile; mKept.end(): not kept
};

// The samples of a ground. World and grid are those of Heightfield: results for samples in memory and in
// tiles are equal to the last bit. One object is for one thread; copies are cheap, and share the tiles.
class GroundSamples {
public:
    // ground must outlive this object.
    GroundSamples(const Heightfield& ground);  // NOLINT: a ground is its samples
    explicit GroundSamples(std::shared_ptr<SurveyTiles> tiles);

    int width() const { return mSize.x; }  // samples, >= 2
    int height() const { return mSize.y; }
    glm::dvec2 spacing() const { return mSpacing; }  // metres
    float minHeight() const { return mLow; }         // metres; for a thinned ground that of the whole one
    float maxHeight() const { return mHigh; }        // metres

    glm::dvec2 gridFromWorld(const glm::dvec2& world) const { return (world - mOrigin) / mSpacing; }
    glm::dvec2 worldFromGrid(const glm::dvec2& grid) const { return mOrigin + grid * mSpacing; }
    // Returns whether a place lies over the grid, its border included.
    bool contains(const glm::dvec2& world) const;

    // Returns the height of a sample, metres; NaN where it is missing. Throws Error where its tile can not be
    // read.
    float sample(int i, int j) const {
        const glm::ivec2 at = mFirst + mStep * glm::ivec2(i, j);
        const float height = mHeights ? mHeights[static_cast<std::size_t>(at.y) * mPitch + at.x] : stored(at);
        return mScale == 1 ? height : static_cast<float>(height / mScale);
    }
    double heightAt(const glm::dvec2& world) const;  // the same as Heightfield::heightAt()

    // Returns every second sample from (firstX, firstY) on. shift: set to the place of the new origin in this
    // world, metres. Requires four samples or more in each direction.
    GroundSamples thinned(int firstX, int firstY, glm::dvec2& shift) const;
    // Returns the same ground with its heights divided by `scale`.
    GroundSamples dividedBy(double scale) const;

private:
    struct Slot {
        glm::ivec2 number{-1};
        std::shared_ptr<const SurveyTiles::Tile> tile;
    };
    float stored(const glm::ivec2& at) const {
        const glm::ivec2 number = at / SurveyTiles::kSide, in = at - number * SurveyTiles::kSide;
        const Slot& slot = mSlots[static_cast<std::size_t>((number.y & 1) * 2 + (number.x & 1))];
        return (slot.number == number
                    ? *slot.tile
                    : *tileOf(number))[static_cast<std::size_t>(in.y * SurveyTiles::kSide + in.x)];
    }
    const SurveyTiles::Tile* tileOf(const glm::ivec2& number) const;

    glm::ivec2 mSize{0}, mFirst{0};
    int mStep = 1;
    glm::dvec2 mSpacing{1.0}, mOrigin{0.0};  // metres; world
    double mScale = 1;
    float mLow = 0, mHigh = 0;        // metres
    const float* mHeights = nullptr;  // null: in tiles
    int mPitch = 0;
    std::shared_ptr<SurveyTiles> mTiles;
    mutable std::array<Slot, 4> mSlots;  // by the tile's odd and even numbers: the four around any corner
};

}  // namespace stereonav
