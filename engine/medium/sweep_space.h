// Where a medium may not be empty: a coarse grid of cells over it, asked for boxes. What sweeps leave out
// is decided here; a box that is said to be empty is empty, displacements counted.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/medium/medium.h"

namespace stereonav {

class SweepSpace {
public:
    SweepSpace() = default;
    explicit SweepSpace(const Medium& medium);

    // From the world to cells: any() takes boxes there.
    glm::dvec3 cellFromWorld(const glm::dvec3& world) const { return mTurn * (world - mOrigin); }
    glm::dvec3 cellDirection(const glm::dvec3& world) const { return mTurn * world; }
    // Whether anything may be in the box (each low <= high).
    bool any(const glm::dvec3& low, const glm::dvec3& high) const;

    // Footprints up to it are counted in layers: metres; infinite for grids.
    double mostFootprint() const { return mMostFootprint; }
    std::size_t heldBytes() const { return mSums.size() * sizeof(std::int32_t); }

private:
    void takeGrid(const Medium& medium);
    void takeLayers(const Medium& medium);
    void spread(const glm::ivec3& cells);
    void sumUp();
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * mSize.y + y) * mSize.x + x;
    }

    glm::dmat3 mTurn{1.0};
    glm::dvec3 mOrigin{0.0};
    glm::ivec3 mSize{0};
    std::vector<std::uint8_t> mFull;
    std::vector<std::int32_t> mSums;  // of full cells before (x, y, z), (size + 1)^3
    double mMostFootprint = 0;
};

}  // namespace stereonav
