// One eye's pinhole projection: position, axes, and a window (an off-axis frustum) on the plane at
// unit view depth. A ray is eye + viewDepth * rayDirection(x, y): its parameter is the view depth.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/math/earth_bend.h"

namespace stereonav {

// The projection of one eye.
struct EyeView {
    glm::dvec3 eye{0.0};                                        // world, metres
    glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  // world, orthonormal
    glm::dvec3 head{0.0};                                       // world: midway between the eyes
    double xMin = -1, xMax = 1, yMin = -1, yMax = 1;            // the window at view depth 1, without unit
    int width = 0, height = 0;                                  // pixels
    double nearDepth = 0.1;                                     // metres, > 0: nearer surfaces are not seen
    double fall = 0;  // 1 / metres, as EarthBend's; 0 where the Earth is level

    double pixelWidth() const { return (xMax - xMin) / width; }    // at view depth 1
    double pixelHeight() const { return (yMax - yMin) / height; }  // at view depth 1
    // Returns the curvature of the Earth for this view.
    EarthBend bend() const { return {glm::dvec2(head), fall}; }

    // x, y: continuous image coordinates, y downwards; (0, 0) is the outer corner of the top left
    // pixel, whose centre is (0.5, 0.5). The result has unit length along `forward`.
    glm::dvec3 rayDirection(double x, double y) const {
        return forward + right * (xMin + x * pixelWidth()) + up * (yMax - y * pixelHeight());
    }

    // Returns the world place that is seen at the image place (x, y) at a view depth in metres.
    glm::dvec3 pointAt(double x, double y, double viewDepth) const {
        return eye + viewDepth * rayDirection(x, y);
    }

    // Returns (x, y) in continuous image coordinates and the view depth. Points with view depth <= 0 lie
    // behind the eye and their x, y mean nothing.
    glm::dvec3 project(const glm::dvec3& world) const;

    // Returns the same view with `factor` x `factor` pixels in place of each, for supersampled truths.
    EyeView supersampled(int factor) const;
};

}  // namespace stereonav
