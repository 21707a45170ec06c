// Where a medium may not be empty: a coarse grid of cells over it, or the bounds of layers' heights, asked
// for boxes. What sweeps leave out is decided here; a box that is said to be empty is empty, displacements
// counted.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/medium/model/medium.h"
#include "engine/medium/sweep/height_bounds.h"
#include "engine/medium/sweep/sweep_geometry.h"

namespace stereonav {

// The rays of a block of a buffer's pixels among the cells of a SweepSpace: at t along the axis they lie in
// the box origin + s way -+ (spread + |s| perWay), s = t - start.
struct SweepBeam {
    glm::dvec3 origin{0.0}, way{0.0}, spread{0.0}, perWay{0.0};  // in cells
    double start = 0;                                            // metres along the axis
    int side = 0;        // the rays are where s has this sign; 0: everywhere
    bool known = false;  // false: some ray hardly crosses the slabs; it may be anywhere
    // Footprints there, metres: the largest of `least` and of both constant + gradient . place.
    struct Footprint {
        glm::dvec3 gradient{0.0};  // a metre of place
        double constant = 0;       // metres
    };
    double least = 0;  // metres
    Footprint footprint[2];
};

class SweepSpace {
public:
    SweepSpace() = default;
    explicit SweepSpace(const Medium& medium);

    // Turn places and directions of the world into cells; with layers alone into metres from the bounds'
    // corner.
    glm::dvec3 cellFromWorld(const glm::dvec3& world) const { return mTurn * (world - mOrigin); }
    glm::dvec3 cellDirection(const glm::dvec3& world) const { return mTurn * world; }
    // Returns the beam of a block of pixels. forward: the fan's rays go to larger t.
    SweepBeam beamOf(const SweepGeometry& geometry, const RayFan& fan, bool forward, double x0, double y0,
                     double x1, double y1) const;
    // Returns the beam of the light, which must be known wherever an eye samples the medium, with the eye's
    // footprint too.
    SweepBeam lightBeamOf(const SweepGeometry& geometry, double x0, double y0, double x1, double y1) const;
    // Returns bits of those of up to 32 planes, at ascending t, where a beam may meet something.
    std::uint32_t planesMet(const SweepBeam& beam, const double* t, int count) const;
    // Returns whether a beam may meet something between two planes on its rays' side.
    bool mayMeet(const SweepBeam& beam, double t0, double t1) const {
        return !beam.known || fillingOf(beam, t0, t1) != Filling::Empty;
    }
    std::size_t heldBytes() const;

private:
    // Whether anything may be in the box (each low <= high); full: in each cell of a box wholly among the
    // cells.
    enum class Filling { Empty, Partly, Full };
    Filling fillingOf(const glm::dvec3& low, const glm::dvec3& high) const;
    Filling fillingOf(const SweepBeam& beam, double t0, double t1) const;
    bool anyLayer(const SweepBeam& beam, const glm::dvec3& low, const glm::dvec3& high) const;
    SweepBeam::Footprint footprintOf(const SweepGeometry& geometry, const RayFan& fan) const;
    double largestFootprint(const SweepGeometry& geometry, const RayFan& fan) const;
    void takeGrid(const Medium& medium);
    void takeLayers(const Medium& medium);
    void spread(const glm::ivec3& cells);
    void sumUp();
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * mSize.y + y) * mSize.x + x;
    }

    glm::dmat3 mTurn{1.0};
    glm::dvec3 mOrigin{0.0};  // world, metres
    glm::ivec3 mSize{0};
    std::vector<std::uint8_t> mFull;
    std::vector<std::int32_t> mSums;  // numbers of full cells before (x, y, z), (size + 1)^3
    std::vector<HeightBounds> mLayers;
    WorldBox mBounds;
};

}  // namespace stereonav
