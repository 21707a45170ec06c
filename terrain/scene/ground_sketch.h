// A coarse copy of a ground, at most 128 x 128 places whatever the ground's size: enough to estimate what
// would be seen of it.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "terrain/ground/heightfield.h"

namespace stereonav {

class GroundSketch {
public:
    static constexpr int kMostSide = 128;  // places a side

    explicit GroundSketch(const Heightfield& ground);

    // Height in metres and slope in metres per metre around a place.
    struct At {
        double height;
        glm::dvec2 gradient;
    };
    // Returns the ground's mean around a place, NaN beyond the border and in holes.
    At at(const glm::dvec2& world) const;
    // Returns the highest sample within a distance in metres, of those that the sketch read; the lowest
    // ground of all where there is none.
    double highestAround(const glm::dvec2& world, double distance) const;

    glm::dvec2 half() const { return mHalf; }      // half extents, metres
    double usualHeight() const { return mUsual; }  // metres, the median
    double highest() const { return mHighest; }    // metres; the largest of the means
    glm::dvec2 summit() const { return mSummit; }  // world; place of the largest mean

private:
    int mWidth = 2, mHeight = 2;                   // places, >= 2
    glm::dvec2 mHalf{1.0}, mStep{1.0};             // metres: half extents, between places
    std::vector<float> mMeans, mTops;              // metres; NaN: unknown
    double mLowest = 0, mUsual = 0, mHighest = 0;  // metres
    glm::dvec2 mSummit{0.0};                       // metres, world
};

}  // namespace stereonav
