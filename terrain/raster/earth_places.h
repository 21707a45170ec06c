// Where places of a terrain's world lie on the Earth.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

namespace stereonav {

// A place on the Earth, radians, WGS 84: north of the equator, -pi/2 to pi/2, and east of Greenwich, -pi to
// pi.
struct EarthPlace {
    double latitude = 0, longitude = 0;  // radians
};

// Places on the Earth and in the world, by the reference system of the world's grid. From any thread, one at
// a time within.
class EarthPlaces {
public:
    virtual ~EarthPlaces() = default;
    // Returns nothing where the system has no such place. world: x, y in metres.
    virtual std::optional<EarthPlace> placeAt(const glm::dvec2& world) const = 0;
    virtual std::optional<glm::dvec2> worldAt(const EarthPlace& place) const = 0;
};

}  // namespace stereonav
