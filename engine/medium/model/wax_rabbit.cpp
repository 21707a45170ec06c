// A rabbit of wax: ellipsoids that flow into each other. Only sums, products and square roots: every machine
// makes the same voxels.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "engine/medium/model/built_in_media.h"
#include "engine/medium/model/sampled_field.h"

namespace stereonav {
namespace {

// Lengths are millimetres: x towards the tail, y away from the viewer, z up.
constexpr double kFloor = 5;  // the sitting rabbit's lowest point

// Returns about the signed distance to an ellipsoid around the origin; exact on its surface.
double ellipsoid(const glm::dvec3& p, const glm::dvec3& radii) {
    const glm::dvec3 scaled = p / radii;
    const double to = glm::length(scaled), slope = glm::length(scaled / radii);
    return slope > 0 ? to * (to - 1) / slope : -std::min({radii.x, radii.y, radii.z});
}

// Returns the smaller one, rounded over a width of `blend` where both are alike.
double joined(double a, double b, double blend) {
    const double near = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - 0.25 * near * near * blend;
}

// Returns about the distance to one ear: a flat ellipsoid, its length along `along`, its width across it in
// the plane of the profile.
double ear(const glm::dvec3& p, double side) {
    const glm::dvec3 along = glm::normalize(glm::dvec3(0.30, 0.20 * side, 1));
    const glm::dvec3 across = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), along));
    const glm::dvec3 through = glm::cross(along, across);
    const glm::dvec3 q = p - glm::dvec3(-9.5, 6.0 * side, 60);
    return ellipsoid({glm::dot(q, across), glm::dot(q, through), glm::dot(q, along)}, {4.6, 2.3, 15.5});
}

// Returns about the signed distance to the rabbit, which is turned by 30 degrees to show its face.
double rabbit(const glm::dvec3& at) {
    constexpr double kCosine = 0.8660254037844386, kSine = 0.5;
    const glm::dvec3 p(kCosine * at.x + kSine * at.y, kCosine * at.y - kSine * at.x, at.z);
    const double side = p.y < 0 ? -1 : 1;
    double d = ellipsoid(p - glm::dvec3(7, 0, 22), {21, 15.5, 16.5});                // body
    d = joined(d, ellipsoid(p - glm::dvec3(-9, 0, 22), {11, 11, 15}), 6);            // chest
    d = joined(d, ellipsoid(p - glm::dvec3(15, 9 * side, 15), {11.5, 8, 11.5}), 3);  // haunch
    d = joined(d, ellipsoid(p - glm::dvec3(-16, 0, 43), {11, 9, 9.5}), 5);           // head
    d = joined(d, ellipsoid(p - glm::dvec3(-25, 0, 40.5), {5.5, 5.5, 5}), 4);        // snout
    d = joined(d, ear(p, side), 2);
    d = joined(d, glm::length(p - glm::dvec3(29, 0, 22)) - 5.5, 2);                    // tail
    d = joined(d, ellipsoid(p - glm::dvec3(-16, 6 * side, 8), {6.5, 4, 4}), 3);        // forepaw
    d = joined(d, ellipsoid(p - glm::dvec3(8, 11 * side, 7.5), {11, 4.5, 3.5}), 2.5);  // hind foot
    return std::max(d, kFloor - p.z);
}

}  // namespace

std::shared_ptr<GreyVolume> makeWaxRabbit() {
    constexpr double kBlur = 1.2;  // millimetres from the surface to the ends of the values
    return sampledField(128, 0.080, {-0.040, -0.040, 0}, [](const glm::dvec3& world) {
        return kMostInField * (0.5 - 0.5 * rabbit(1000.0 * world) / kBlur);
    });
}

}  // namespace stereonav
