// How steeply a ground rises as seen from its samples: what hides the sky, exact on the mesh of
// ground_rays.h.
//
// A walk over the plan along the maxima of blocks of cells, as rays leap along them: a block whose maximum
// can not be seen above what was found already is left out as a whole. Of a cell the mesh is met at its
// border and its diagonal, between which it is straight: no other place of it can be steeper.
#pragma once

#include <glm/vec2.hpp>

#include "terrain/ground/height_pyramid.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

class GroundHorizon {
public:
    // ground must outlive this. Holds 5.4 bytes a sample.
    explicit GroundHorizon(const Heightfield& ground);
    // Finds horizons of a part of a larger ground, at finer samples: what lies beyond it is looked at in the
    // whole. offset: metres, from the part's world to the whole's. Both must outlive this.
    GroundHorizon(const Heightfield& part, const GroundHorizon& whole, const glm::dvec2& offset);

    const Heightfield& ground() const { return mGround; }

    // Returns the rise over run, 0 or more, of the steepest line from sample (i, j), which is known, to the
    // ground in a horizontal unit direction (metres). Infinite where heights are too large for their
    // distance. From any thread.
    double steepest(int i, int j, const glm::dvec2& direction) const;

private:
    // A way over the plan.
    struct Way {
        glm::dvec2 start;  // grid
        glm::dvec2 step;   // grid, a metre
        double height;     // metres, at its start
    };
    // Returns the steepest slope to what lies on the way further than `from` metres, or `found` where that is
    // more. cell: at `from`.
    double along(const Way& way, glm::ivec2 cell, double from, double found) const;
    double inCell(const Way& way, const glm::ivec2& cell, double from, double to) const;

    const Heightfield& mGround;
    HeightPyramid mMaxima;
    const GroundHorizon* mWhole = nullptr;  // null: this is no part
    glm::dvec2 mOffset{0.0};                // metres, to its world
};

}  // namespace stereonav
