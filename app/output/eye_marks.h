// Positions in both eyes' pictures of marks that are drawn over them, so that both eyes see a mark at one
// depth.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/camera/stereo_rig.h"
#include "engine/image/plane.h"

namespace stereonav {

// Position in each eye's picture, in pixels with fractions; (0, 0) is the top left corner.
struct EyeMark {
    glm::dvec2 left{0.0}, right{0.0};
};

// Returns the mark at a place of the left eye's picture, given as shares of its size, on the visible surface
// (viewDepth: of the left eye); in the plane of the screen where nothing is hit or known, or the place lies
// outside the picture. guard: pixels of viewDepth on each side that lie outside the picture.
EyeMark markUnder(const StereoViews& views, const Plane<float>& viewDepth, const glm::dvec2& share,
                  const glm::ivec2& guard = glm::ivec2(0));

// Returns the point on the surface that markUnder() finds, at the middle of viewDepth's pixel. Returns
// nothing where nothing is hit or known, or the place lies outside the picture.
std::optional<glm::dvec3> worldUnder(const StereoViews& views, const Plane<float>& viewDepth,
                                     const glm::dvec2& share, const glm::ivec2& guard = glm::ivec2(0));

struct PointMark {
    EyeMark mark;
    double depth = 0;  // depth in the view, metres
};
// Returns the mark of a point of the world, at its apparent place over a round Earth. Returns nothing where
// the point is nearer than the near plane or behind the eyes, outside one of the pictures, or hidden.
std::optional<PointMark> markOf(const StereoViews& views, const Plane<float>& viewDepth,
                                const glm::dvec3& world, const glm::ivec2& guard = glm::ivec2(0));

}  // namespace stereonav
