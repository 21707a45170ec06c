// The apparent shape of a round Earth under air that bends light: ground appears lower by fall * d^2, where d
// is its distance from the eye in plan. Places in the world are stored over level ground. The place where one
// is seen, in pictures and their depths, is its apparent place.
//
// Bending the ray is the same as lowering the ground: a straight line of sight that has come a distance d
// in plan is fall * d^2 higher over level ground than it looks.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace stereonav {

constexpr double kEarthRadius = 6371008.8;  // metres: the mean one of WGS 84 (IUGG)
constexpr double kUsualRefraction = 0.13;   // share of the curvature: Gauss's coefficient, in the Earth's air

// The body that ground lies on: the Earth or another one.
struct Body {
    double meanRadius = 0;  // metres, from its reference system; 0: unknown

    // Returns whether the body is the Earth: also true for an unknown radius. Its ellipsoids and spheres
    // differ little; Venus is 5 % smaller.
    constexpr bool isEarth() const {
        constexpr double kAlike = 0.005;
        return meanRadius <= 0 ||
               (meanRadius > (1 - kAlike) * kEarthRadius && meanRadius < (1 + kAlike) * kEarthRadius);
    }
    constexpr double radius() const { return isEarth() ? kEarthRadius : meanRadius; }  // metres
    // Returns the default refraction, 0 to 1; 0 for other bodies than the Earth, whose air is not known.
    constexpr double usualRefraction() const { return isEarth() ? kUsualRefraction : 0; }
};

// Returns `fall`, 1 / metres: at a distance of d metres the ground sinks by fall * d^2 metres. refraction:
// share of the curvature that light follows, 0 to 1; with 1 nothing sinks. A parabola replaces the sphere:
// 100 km away they differ by 8 cm.
constexpr double curvatureFall(double refraction, const Body& body = {}) {
    return (1 - refraction) / (2 * body.radius());
}

// The Earth's curvature around an eye.
struct EarthBend {
    glm::dvec2 middle{0.0};  // world: below the head, so that both eyes see one surface
    double fall = 0;         // 1 / metres, >= 0; 0: the Earth is level

    // Returns the metres by which the ground at a place sinks.
    double sinkAt(const glm::dvec2& place) const {
        const glm::dvec2 way = place - middle;
        return fall * glm::dot(way, way);
    }
    // Returns the apparent place of a place in the world.
    glm::dvec3 apparent(const glm::dvec3& place) const {
        return {place.x, place.y, place.z - sinkAt(glm::dvec2(place))};
    }
    // Returns the place in the world whose apparent place is given.
    glm::dvec3 placeOf(const glm::dvec3& apparent) const {
        return {apparent.x, apparent.y, apparent.z + sinkAt(glm::dvec2(apparent))};
    }
    // Returns the direction from an eye to the place in the world that it sees at eye + t * direction, such
    // that eye + t * result is that place; t must not be 0.
    glm::dvec3 wayToPlace(const glm::dvec3& eye, const glm::dvec3& direction, double t) const {
        return {direction.x, direction.y, direction.z + sinkAt(glm::dvec2(eye + t * direction)) / t};
    }
};

}  // namespace stereonav
