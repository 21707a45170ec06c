// Visibility of one place from another over the ground: exact on the bilinear surface that pictures are cast
// against, cell by cell, with leaps over blocks that lie below the line (terrain/ground/height_pyramid.h). In
// every cell the ground's height over the line is a quadratic, whose largest value is known in closed form.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/math/earth_bend.h"
#include "terrain/ground/height_pyramid.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

class GroundSamples;  // terrain/survey/ground_samples.h

// Result for a line of sight. Distances are metres in plan.
struct Sight {
    bool seen = false;
    // Metres from ground to line at the closest place; below 0: the line is hidden by so much.
    double clearance = 0;
    double at = 0;  // distance of that place from the eye
};

// Measures the line between two places as SightLines::measure() does, by a walk over all cells below it: for
// a single line, for which a pyramid would cost more than it saves. fall: curvatureFall(), 1/metre.
Sight sightOver(const GroundSamples& ground, double fall, const glm::dvec3& eye, const glm::dvec3& target);

class SightLines {
public:
    // ground and maxima must outlive this object. fall: curvatureFall(), 1/metre; 0 for level ground.
    SightLines(const Heightfield& ground, const HeightPyramid& maxima, double fall);

    const Heightfield& ground() const { return mGround; }
    double fall() const { return mFall; }  // 1/metre

    // Returns whether one place sees the other: x, y in the grid's units, z in metres; on the grid, or above
    // it. Grazing counts as seen: a line may lie below the ground by the rounding errors of heights. Missing
    // ground hides nothing.
    bool sees(const glm::dvec3& eye, const glm::dvec3& target) const { return clear(eye, target, 0, 1); }
    // Tests the same for the part of the line between the shares `from` and `to` of it, 0 to 1.
    bool clear(const glm::dvec3& eye, const glm::dvec3& target, double from, double to) const;
    // Measures the whole line, including its ends, and where it is closest to the ground.
    Sight measure(const glm::dvec3& eye, const glm::dvec3& target) const;

    // Returns a bound in metres: no line from there to a sample that lies farther below the ground counts as
    // seen. Heights: metres; eyeHeight as in sees(), targetHeight above the samples.
    double grazing(const glm::dvec2& eye, double eyeHeight, double targetHeight) const;

private:
    const Heightfield& mGround;
    const HeightPyramid& mMaxima;
    double mFall, mTallest;  // 1/metre; metres
};

}  // namespace stereonav
