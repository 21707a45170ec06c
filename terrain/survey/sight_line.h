// Whether one place sees another over the ground: exact on the bilinear surface that pictures are cast
// against, cell by cell, with leaps over blocks that lie below the line (terrain/ground/height_pyramid.h).
// Every cell's height along the line is a quadratic, so its largest value is known in closed form.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/math/earth_bend.h"
#include "terrain/ground/height_pyramid.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

class GroundSamples;  // terrain/survey/ground_samples.h

// A line of sight. Distances are metres over the plan.
struct Sight {
    bool seen = false;
    double clearance = 0;  // metres from ground to line where it is least; below 0: hidden by so much
    double at = 0;         // distance from the eye of that place
};

// Measures the line between two places as SightLines::measure() does, by a walk over all cells below it: for
// one line, for which maxima are not worth making. Places as there; fall: curvatureFall(), 1/metre.
Sight sightOver(const GroundSamples& ground, double fall, const glm::dvec3& eye, const glm::dvec3& target);

class SightLines {
public:
    // ground and maxima live as long. fall: curvatureFall(), 1/metre; 0 for level ground.
    SightLines(const Heightfield& ground, const HeightPyramid& maxima, double fall);

    const Heightfield& ground() const { return mGround; }
    double fall() const { return mFall; }  // 1/metre

    // Returns whether one place sees the other: x, y in the grid's units, z in metres; on the grid, or above
    // it. Grazing counts as seen: a line may lie below the ground by what rounding makes of heights. Ground
    // that is missing hides nothing.
    bool sees(const glm::dvec3& eye, const glm::dvec3& target) const { return clear(eye, target, 0, 1); }
    // Answers the same for the part of the line from share `from` to share `to` of it, 0 to 1.
    bool clear(const glm::dvec3& eye, const glm::dvec3& target, double from, double to) const;
    // Measures the whole line, its ends included, with where it is closest to the ground.
    Sight measure(const glm::dvec3& eye, const glm::dvec3& target) const;

    // Returns metres, no less than a line from there to any sample may lie under the ground by and count as
    // seen. Heights: metres; eyeHeight as in sees(), targetHeight over the samples.
    double grazing(const glm::dvec2& eye, double eyeHeight, double targetHeight) const;

private:
    const Heightfield& mGround;
    const HeightPyramid& mMaxima;
    double mFall, mTallest;  // 1/metre; metres
};

}  // namespace stereonav
