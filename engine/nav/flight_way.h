// The places that a flight to a goal leads over: straight where that is clear, over the ground and around
// what is in the way else.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/nav/flight.h"

namespace stereonav {

// Places with straight lines between them, by arc length.
class FlightWay {
public:
    FlightWay() = default;
    // The way through these places, at least one, all finite, metres.
    explicit FlightWay(std::vector<glm::dvec3> places);

    double length() const { return mAlong.empty() ? 0 : mAlong.back(); }  // metres
    // share: of the length, clamped to 0..1.
    glm::dvec3 at(double share) const;

private:
    std::vector<glm::dvec3> mPlaces;  // world, metres
    std::vector<double> mAlong;       // metres from the first
};

// Returns the way from one place to another as `flight` may fly it. Over ground: the straight way, raised to
// where the viewer is let, smoothly: the highest ground nearby is flown over, less near the ends, which stay
// as they are (both must be clear). Between walls: straight, or the tightest of some bends that are clear;
// the straight one where none is, so that the flight ends at the wall.
FlightWay wayBetween(const Flight& flight, const glm::dvec3& from, const glm::dvec3& to);

}  // namespace stereonav
