// The route of a flight to a goal: straight where that is clear, otherwise over the ground and around
// obstacles.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/nav/flight.h"

namespace stereonav {

// Places with straight lines between them, by arc length.
class FlightWay {
public:
    FlightWay() = default;
    // Makes the route through these places: at least one, all finite, metres.
    explicit FlightWay(std::vector<glm::dvec3> places);

    double length() const { return mAlong.empty() ? 0 : mAlong.back(); }  // metres
    // Returns the place at a share of the length, clamped to 0..1.
    glm::dvec3 at(double share) const;

private:
    std::vector<glm::dvec3> mPlaces;  // world, metres
    std::vector<double> mAlong;       // metres from the first
};

// Returns a route from one place to another for `flight`. Over ground it is the straight line, raised
// smoothly above the highest ground nearby, less so near the ends, which stay as they are (both must be
// clear). Between walls it is straight, or the tightest of some bends that are clear; if none is clear it is
// straight, so that the flight ends at the wall.
FlightWay wayBetween(const Flight& flight, const glm::dvec3& from, const glm::dvec3& to);

}  // namespace stereonav
