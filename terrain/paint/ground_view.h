// The ground at a pixel of one eye: where its ray meets the surface, and how that place moves from pixel to
// pixel. The basis of everything that is painted on the ground.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/camera/eye_view.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// The ground that a pixel shows.
struct GroundSeen {
    glm::dvec3 place{0.0};      // world, metres, on the ground
    double depth = 0;           // metres along the view
    glm::dvec3 direction{0.0};  // from the eye to the place, per metre of depth
    glm::dvec2 gradient{0.0};   // gradient of the bilinear surface there, metres per metre
    // Metres by which the place moves on the tangent plane from this pixel to the next one on the right, and
    // to the one below.
    glm::dvec3 perX{0.0}, perY{0.0};
};

// The ground and a view of it, both of which must outlive this object. Over a round Earth the ray meets the
// apparent ground (engine/math/earth_bend.h); places and gradients are those of the real ground.
class GroundView {
public:
    GroundView(const Heightfield& ground, const EyeView& view);

    static constexpr double kSameCell = 0.25;  // spacings: a shorter first step stays in the same cell

    // Finds the ground that pixel x, y shows. depth: metres, from the eye's picture. A warped eye's depth may
    // be that of a neighbouring pixel, and every depth is rounded, so the ray is followed to the surface: by
    // Newton's steps on the cell's tangent plane, and where these lead to other cells by steps along the ray,
    // to the first hit within two pixels, or else to the point nearest to the ground. Returns false where
    // nothing was hit, outside the ground, in its holes, and where an object on the ground was hit: its
    // distance from the ground is more than two pixels and a thousandth of the depth.
    bool at(int x, int y, float depth, GroundSeen& seen) const;

private:
    struct Cell {
        // Metres, and metres per metre; apparent ones over a round Earth.
        double height;
        glm::dvec2 gradient;
        double seenHeight;
        glm::dvec2 seenGradient;
    };
    bool cellAt(const glm::dvec3& place, Cell& cell) const;
    // Returns the height in metres of a ray's point above the ground; NaN where there is no ground.
    double over(const glm::dvec3& ray, double t, Cell& cell) const;
    // Change of the tangent plane's view depth in metres to the next pixel on the right and below; into:
    // component of the ray along the plane's normal, below 0 where the plane faces the eye.
    struct PerPixel {
        double into, x, y;
    };
    PerPixel perPixel(const glm::dvec3& ray, double t, const Cell& cell) const;
    struct Way {
        double t;  // view depth, metres
        bool found;
        bool beside = false;  // the ray misses the ground here: its point is above or below it
    };
    Way followed(const glm::dvec3& ray, double depth, Cell& cell) const;
    Way searched(const glm::dvec3& ray, double depth, Cell& cell) const;

    const Heightfield& mGround;
    const EyeView& mView;
    EarthBend mBend;
    glm::dvec3 mRight, mUp;  // a pixel's width and height at view depth 1
    double mSpacing;         // metres between samples, the smaller of both directions
};

}  // namespace stereonav
