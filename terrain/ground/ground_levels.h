// A ground with coarser and coarser sampling, and for each level a bound of its distance to the ground
// itself.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "terrain/ground/heightfield.h"
#include "terrain/ground/level_step.h"

namespace stereonav {

// A ground whose levels are stored outside memory, as on disk (terrain/tiles). The sizes of the levels follow
// from the first one.
struct StoredLevels {
    glm::ivec2 size{0};                      // samples of the ground itself
    glm::dvec2 spacing{1.0};                 // metres between them
    float low = 0, high = 0;                 // metres, of all known samples
    std::uint64_t content = 0;               // identifies the heights of all levels
    std::vector<std::vector<float>> bounds;  // by level: its blocks' bounds, row by row; metres
    // Writes samples low to low + size - 1 of a level, metres, NaN where missing; from several threads at
    // once.
    std::function<void(int level, const glm::ivec2& low, const glm::ivec2& size, float* heights)> read;
};

// Levels of a ground. Sample (i, j) of level k lies at sample (i, j) * 2^k of the ground. From one level to
// the next heights are averaged with the weights 1 2 1 in both directions over the known samples; missing
// samples stay missing. A level ends at its last sample: up to 2^k - 1 cells in the north and east of the
// ground are not part of it.
class GroundLevels {
public:
    static constexpr int kBlock = kLevelBlock;  // cells of a level along each side of a block

    // ground must outlive this object. A coarser level is made only if it has at least kBlock cells in each
    // direction.
    explicit GroundLevels(const Heightfield& ground);
    // Uses stored levels, whose heights are read when they are needed.
    explicit GroundLevels(StoredLevels stored);

    int count() const { return static_cast<int>(mLevels.size()); }  // level 0 is the ground
    glm::ivec2 size(int level) const { return mLevels[level].size; }
    glm::dvec2 spacing(int level) const { return mSpacing * double(1 << level); }  // metres
    glm::dvec2 originWorld() const { return mOrigin; }  // place of sample (0, 0) of every level, metres
    float minHeight() const { return mLow; }            // metres, of the ground
    float maxHeight() const { return mHigh; }           // metres
    // Return the grid coordinates of level 0 for a place in the world, metres, and whether the place is over
    // the ground.
    glm::dvec2 gridFromWorld(const glm::dvec2& world) const { return (world - mOrigin) / mSpacing; }
    bool contains(const glm::dvec2& world) const;
    bool stored() const { return mGround == nullptr; }  // whether elsewhere than in memory
    // Returns a number that identifies the heights of all levels: a hash of level 0, or
    // StoredLevels::content.
    std::uint64_t content() const;

    glm::ivec2 blocks(int level) const { return mLevels[level].blocks; }  // each way
    // Returns a bound in metres: over that block, the surface of that level differs from the ground's by at
    // most this much, where both are known. 0 at level 0.
    float errorBound(int level, int blockI, int blockJ) const {
        return mLevels[level].bounds[static_cast<std::size_t>(blockJ) * mLevels[level].blocks.x + blockI];
    }
    // Returns the bound in metres of the block that contains a place in the world; beyond the border, of the
    // nearest block.
    float errorBoundAt(int level, const glm::dvec2& world) const;
    float errorBound(int level) const { return mLevels[level].most; }  // the largest of a level, metres

    // Returns samples low to low + size - 1 of a level; empty where none of their cells is known. Throws
    // Error where stored samples can not be read.
    std::optional<Heightfield> part(int level, const glm::ivec2& low, const glm::ivec2& size) const;
    // Writes the same samples as heights in metres, in rows of size.x, NaN where missing.
    void read(int level, const glm::ivec2& low, const glm::ivec2& size, float* heights) const;
    std::size_t byteCount() const;  // bytes in memory, without the ground

private:
    struct Level {
        glm::ivec2 size{0}, blocks{0};
        std::vector<float> heights;  // empty at level 0, and where they are stored
        std::vector<float> bounds;   // by block, metres
        float most = 0;              // the largest of the bounds, metres
    };
    void addLevel();
    LevelRows rowsOf(int level) const;

    const Heightfield* mGround = nullptr;    // null: stored
    glm::dvec2 mSpacing{1.0}, mOrigin{0.0};  // metres; world
    float mLow = 0, mHigh = 0;               // metres
    std::vector<Level> mLevels;
    std::uint64_t mContent = 0;  // StoredLevels::content
    std::function<void(int, const glm::ivec2&, const glm::ivec2&, float*)> mRead;
};

}  // namespace stereonav
