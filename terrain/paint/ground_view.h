// The ground as a pixel of one eye shows it: where its ray meets the surface, and what lies beside that from
// pixel to pixel. What is painted on the ground begins here.
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
    glm::dvec3 direction{0.0};  // from the eye to the place, for a metre of depth
    glm::dvec2 gradient{0.0};   // gradient of the bilinear surface there, metres a metre
    // Metres by which the place moves on the tangent plane from this pixel to the next at the right and
    // below.
    glm::dvec3 perX{0.0}, perY{0.0};
};

// The ground and a view of it, which must outlive this. Of a view over a round Earth the ray meets the ground
// as it is seen (engine/math/earth_bend.h), and places and gradients are those of the ground.
class GroundView {
public:
    GroundView(const Heightfield& ground, const EyeView& view);

    static constexpr double kSameCell = 0.25;  // spacings: a first step so short misses no other cell

    // Sets what pixel x, y shows. depth: metres, what the eye has in its picture. A warped eye's depth is
    // that of a pixel beside, and any eye's is rounded, so the ray is followed on to the surface itself: by
    // Newton's steps on the cell's tangent plane, and where these lead to other cells by steps along the ray,
    // to where it first meets the ground within two pixels, or else comes next to it. Returns false where
    // nothing was hit, beside the ground, in its holes, and where what was hit is not the ground but stands
    // on it: farther from it than two pixels and a thousandth of the way.
    bool at(int x, int y, float depth, GroundSeen& seen) const;

private:
    struct Cell {
        // Metres, and metres a metre; seen: over a round Earth.
        double height;
        glm::dvec2 gradient;
        double seenHeight;
        glm::dvec2 seenGradient;
    };
    bool cellAt(const glm::dvec3& place, Cell& cell) const;
    // Metres that a ray's place is over the ground below it; NaN where there is none.
    double over(const glm::dvec3& ray, double t, Cell& cell) const;
    // Metres of view depth that the tangent plane is farther away at the next pixel to the right and below;
    // into: the ray's share along the plane's normal, below 0 where it faces the eye.
    struct PerPixel {
        double into, x, y;
    };
    PerPixel perPixel(const glm::dvec3& ray, double t, const Cell& cell) const;
    struct Way {
        double t;  // view depth, metres
        bool found;
        bool beside = false;  // the ray passes by: the place is over or under it
    };
    Way followed(const glm::dvec3& ray, double depth, Cell& cell) const;
    Way searched(const glm::dvec3& ray, double depth, Cell& cell) const;

    const Heightfield& mGround;
    const EyeView& mView;
    EarthBend mBend;
    glm::dvec3 mRight, mUp;  // a pixel's width and height at view depth 1
    double mSpacing;         // metres between samples, the lesser of both
};

}  // namespace stereonav
