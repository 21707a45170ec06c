// The ground as a mesh for Embree: two triangles a cell, split from its south-east to its north-west corner
// (as Embree's own grids are). Cells that touch a hole are left out. For baking light; pictures are cast
// against the bilinear surface.
#pragma once

#include <cstdint>
#include <memory>

#include "terrain/ground/heightfield.h"

namespace stereonav {

// Sixteen rays in the ray mesh's space, metres: world, less centreHeight() in z.
struct RayPacket {
    static constexpr int kSize = 16;
    alignas(64) float originX[kSize], originY[kSize], originZ[kSize];
    alignas(64) float directionX[kSize], directionY[kSize], directionZ[kSize];  // vectors of any length
    alignas(64) float nearest[kSize];  // start of the ray, in multiples of its direction
    // Distance of the hit in the same unit, set by intersect(); infinite: a miss.
    alignas(64) float distance[kSize];
};

// Returns the bytes for rays over `samples` samples: Embree's vertices and the tree over them. For small
// grounds Embree's own blocks take most: 1,024 x 1,024 samples took 59 MB more than the vertices, and so did
// 4,000 x 4,000 (two threads).
constexpr double rayBytes(double samples) {
    return 40 * samples + (samples < 1e6 ? 60 * samples : 60e6);
}

class GroundRays {
public:
    // ground must outlive this object. Throws Error where it has more samples than the mesh can index.
    explicit GroundRays(const Heightfield& ground);
    // Makes rays over a part of a larger ground, with finer samples: rays that leave it continue over the
    // whole. offset: metres, from the part's world to the whole's. Both must outlive this object.
    GroundRays(const Heightfield& part, const GroundRays& whole, const glm::dvec2& offset);
    ~GroundRays();

    // active: bit k for ray k. Returns the bits of the active rays that hit the ground. From any thread.
    std::uint32_t occluded(const RayPacket& rays, std::uint32_t active) const;
    // Sets `distance` of the active rays. From any thread.
    void intersect(RayPacket& rays, std::uint32_t active) const;

    double centreHeight() const { return mCentreHeight; }  // metres, half way up the ground
    // Returns the height in metres by which starts are lifted off the ground: more than rounding errors, and
    // a small part of a cell.
    double lift() const { return mLift; }
    const Heightfield& ground() const { return mGround; }

    // Returns the height of the mesh in metres at a world position (clamped to the ground), which differs a
    // little from that of the bilinear surface.
    double heightAt(const glm::dvec2& world) const;

private:
    // Returns the rays that continue over the whole ground, from where they leave this part.
    RayPacket beyond(const RayPacket& rays) const;
    std::uint32_t occludedHere(const RayPacket& rays, std::uint32_t active) const;
    void intersectHere(RayPacket& rays, std::uint32_t active) const;

    struct State;
    const Heightfield& mGround;
    double mCentreHeight, mLift;  // metres
    std::unique_ptr<State> mState;
    const GroundRays* mWhole = nullptr;  // null: this is not a part
    glm::dvec2 mOffset{0.0};             // metres, to its world
};

}  // namespace stereonav
