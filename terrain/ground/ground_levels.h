// A ground at coarser and coarser sampling, with a bound of how far each level lies from the ground itself.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "terrain/ground/heightfield.h"

namespace stereonav {

// Sample (i, j) of level k lies at sample (i, j) * 2^k of the ground. From one level to the next heights are
// averaged with the weights 1 2 1 each way, over the samples that are known; a sample that is missing stays
// so. A level ends at its last sample: up to 2^k - 1 cells at the ground's north and east are not part of it.
class GroundLevels {
public:
    static constexpr int kBlock = 64;  // cells of a level along each side of a block

    // ground must outlive this. Levels end before one that would have less than a block each way.
    explicit GroundLevels(const Heightfield& ground);

    const Heightfield& ground() const { return mGround; }
    int count() const { return static_cast<int>(mLevels.size()); }  // level 0 is the ground
    glm::ivec2 size(int level) const { return mLevels[level].size; }
    const float* heights(int level) const;  // row 0 southernmost; as many as size() says
    glm::dvec2 spacing(int level) const { return mGround.spacing() * double(1 << level); }

    glm::ivec2 blocks(int level) const { return mLevels[level].blocks; }
    // Metres: the surface of that level is nowhere further from the ground's, above or below, over that
    // block, where both are known. 0 at level 0.
    float errorBound(int level, int blockI, int blockJ) const {
        return mLevels[level].bounds[static_cast<std::size_t>(blockJ) * mLevels[level].blocks.x + blockI];
    }
    float errorBound(int level) const;  // the largest of a level

    // Samples low to low + size - 1 of a level.
    Heightfield part(int level, const glm::ivec2& low, const glm::ivec2& size) const;
    std::size_t byteCount() const;  // beside the ground

private:
    struct Level {
        glm::ivec2 size{0}, blocks{0};
        std::vector<float> heights;  // empty at level 0
        std::vector<float> bounds;
    };
    void addLevel();
    float boundOf(const Level& made, int blockI, int blockJ) const;

    const Heightfield& mGround;
    std::vector<Level> mLevels;
};

}  // namespace stereonav
