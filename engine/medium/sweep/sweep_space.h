// Finds the parts of a medium that are certainly empty, from a coarse grid of cells over it, or from bounds
// of layers' heights. Sweeps skip what it reports as empty; displacements are included.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/medium/model/medium.h"
#include "engine/medium/sweep/height_bounds.h"
#include "engine/medium/sweep/sweep_geometry.h"

namespace stereonav {

// A bound of the rays of a block of pixels, in cells of a SweepSpace: at t along the axis they lie in the box
// origin + s way -+ (spread + |s| perWay), s = t - start.
struct SweepBeam {
    glm::dvec3 origin{0.0}, way{0.0}, spread{0.0}, perWay{0.0};  // in cells
    double start = 0;                                            // metres along the axis
    int side = 0;        // sign of s for which the rays exist; 0: both
    bool known = false;  // false: some ray is nearly parallel to the slabs, and the beam may be anywhere
    // Footprints of samples there, metres: the largest of `least` and two linear functions of the place,
    // constant + gradient . place.
    struct Footprint {
        glm::dvec3 gradient{0.0};  // per metre of the place
        double constant = 0;       // metres
    };
    double least = 0;  // metres
    Footprint footprint[2];
};

class SweepSpace {
public:
    SweepSpace() = default;
    explicit SweepSpace(const Medium& medium);

    // Convert places and directions in the world into cells; without a grid, into metres from the corner of
    // the bounds.
    glm::dvec3 cellFromWorld(const glm::dvec3& world) const { return mTurn * (world - mOrigin); }
    glm::dvec3 cellDirection(const glm::dvec3& world) const { return mTurn * world; }
    // Returns the beam of a block of pixels. forward: the fan's rays go to larger t.
    SweepBeam beamOf(const SweepGeometry& geometry, const RayFan& fan, bool forward, double x0, double y0,
                     double x1, double y1) const;
    // Returns the beam of the light, which must be known wherever an eye samples the medium, with the eye's
    // footprint too.
    SweepBeam lightBeamOf(const SweepGeometry& geometry, double x0, double y0, double x1, double y1) const;
    // Returns, as bits, those of up to 32 planes, at ascending t, on which a beam may meet something.
    std::uint32_t planesMet(const SweepBeam& beam, const double* t, int count) const;
    // Returns whether a beam may meet something between two planes, on the side where its rays are.
    bool mayMeet(const SweepBeam& beam, double t0, double t1) const {
        return !beam.known || fillingOf(beam, t0, t1) != Filling::Empty;
    }
    std::size_t heldBytes() const;

private:
    // Whether something may be in the box (each low <= high); Full: in each cell of a box that lies
    // completely within the cells.
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
    std::vector<std::int32_t> mSums;  // number of full cells before (x, y, z), (size + 1)^3
    std::vector<HeightBounds> mLayers;
    WorldBox mBounds;
};

}  // namespace stereonav
