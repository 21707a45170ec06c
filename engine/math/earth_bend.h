// The Earth's curvature, and the air that bends light after it, as an eye sees them: ground lies lower by
// fall * d^2, where d is its distance from the eye over the plan. A place of the world is kept as it is, over
// level ground. Where it is seen, in pictures and by their depths, is its apparent place.
//
// Bending the ray is the same as lowering the ground: a straight line of sight that has come a distance d
// over the plan is fall * d^2 higher over level ground than it looks.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace stereonav {

constexpr double kEarthRadius = 6371008.8;  // metres: the mean one of WGS 84 (IUGG)
constexpr double kUsualRefraction = 0.13;   // share of the curvature: Gauss's coefficient, in the Earth's air

// The body that ground lies on: the Earth or another one.
struct Body {
    double meanRadius = 0;  // metres, as its reference system has it; 0: not said

    // Returns whether the body is the Earth, as every body is that does not say otherwise: its ellipsoids and
    // spheres are all alike, Venus is 5 % smaller.
    constexpr bool isEarth() const {
        constexpr double kAlike = 0.005;
        return meanRadius <= 0 ||
               (meanRadius > (1 - kAlike) * kEarthRadius && meanRadius < (1 + kAlike) * kEarthRadius);
    }
    constexpr double radius() const { return isEarth() ? kEarthRadius : meanRadius; }  // metres
    // The refraction where none is said, 0 to 1: air is known of the Earth alone.
    constexpr double usualRefraction() const { return isEarth() ? kUsualRefraction : 0; }
};

// Returns `fall`, 1 / metres: at a distance of d metres the ground sinks by fall * d^2 metres. refraction:
// the share of the curvature that light follows, 0 to 1; with 1 nothing sinks. A parabola in the place of the
// sphere: 100 km away the two are 8 cm apart.
constexpr double curvatureFall(double refraction, const Body& body = {}) {
    return (1 - refraction) / (2 * body.radius());
}

// The Earth's bend as an eye sees it.
struct EarthBend {
    glm::dvec2 middle{0.0};  // world: below the head, so that both eyes see one surface
    double fall = 0;         // 1 / metres, >= 0; 0: the Earth is level

    // Metres by which the ground sinks there.
    double sinkAt(const glm::dvec2& place) const {
        const glm::dvec2 way = place - middle;
        return fall * glm::dot(way, way);
    }
    // Returns where a place of the world is seen.
    glm::dvec3 apparent(const glm::dvec3& place) const {
        return {place.x, place.y, place.z - sinkAt(glm::dvec2(place))};
    }
    // Returns the place of the world that is seen there.
    glm::dvec3 placeOf(const glm::dvec3& apparent) const {
        return {apparent.x, apparent.y, apparent.z + sinkAt(glm::dvec2(apparent))};
    }
    // Returns the direction from an eye towards the place of the world that it sees at eye + t * direction:
    // also at that t, which is not 0.
    glm::dvec3 wayToPlace(const glm::dvec3& eye, const glm::dvec3& direction, double t) const {
        return {direction.x, direction.y, direction.z + sinkAt(glm::dvec2(eye + t * direction)) / t};
    }
};

}  // namespace stereonav
