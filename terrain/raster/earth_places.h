// Conversion of places in a terrain's world to places on the Earth.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

namespace stereonav {

// A place on the Earth, radians, WGS 84: north of the equator, -pi/2 to pi/2, and east of Greenwich, -pi to
// pi.
struct EarthPlace {
    double latitude = 0, longitude = 0;  // radians
};

// Converts places between the Earth and the world, by the reference system of the world's grid. May be called
// from any thread; calls wait for each other.
class EarthPlaces {
public:
    virtual ~EarthPlaces() = default;
    // Returns the place on the Earth; empty where the system defines none. world: x, y in metres.
    virtual std::optional<EarthPlace> placeAt(const glm::dvec2& world) const = 0;
    virtual std::optional<glm::dvec2> worldAt(const EarthPlace& place) const = 0;
};

}  // namespace stereonav
