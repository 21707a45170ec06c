// The steepest slope of a ground as seen from its samples, up to which it hides the sky; exact on the mesh of
// ground_rays.h.
//
// A line of sight walks over the plan and leaps over blocks of cells by their maxima: a block is skipped
// where its maximum can not rise above the slope found so far. In a cell the slope to the mesh is taken at
// the cell's border and its diagonal, between which the mesh is straight: no other point can be steeper.
#pragma once

#include <glm/vec2.hpp>

#include "terrain/ground/height_pyramid.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

class GroundHorizon {
public:
    // ground must outlive this object. Takes 5.4 bytes per sample.
    explicit GroundHorizon(const Heightfield& ground);
    // Finds horizons of a part of a larger ground, with finer samples; beyond the part the whole ground is
    // used. offset: metres, from the part's world to the whole's. Both must outlive this object.
    GroundHorizon(const Heightfield& part, const GroundHorizon& whole, const glm::dvec2& offset);

    const Heightfield& ground() const { return mGround; }

    // Returns the slope (rise over run), 0 or more, of the steepest line from sample (i, j), which must be
    // known, to the ground in a horizontal unit direction. Infinite where heights are too large for their
    // distance. From any thread.
    double steepest(int i, int j, const glm::dvec2& direction) const;

private:
    // A straight line over the plan.
    struct Way {
        glm::dvec2 start;  // grid
        glm::dvec2 step;   // grid units per metre
        double height;     // metres, at its start
    };
    // Returns the steepest slope to the ground along the line beyond `from` metres, or `found` where that is
    // steeper. cell: the cell at `from`.
    double along(const Way& way, glm::ivec2 cell, double from, double found) const;
    double inCell(const Way& way, const glm::ivec2& cell, double from, double to) const;

    const Heightfield& mGround;
    HeightPyramid mMaxima;
    const GroundHorizon* mWhole = nullptr;  // null: this is not a part
    glm::dvec2 mOffset{0.0};                // metres, to its world
};

}  // namespace stereonav
