// Where something that is drawn over the picture lies in each eye's picture, so that both eyes see it at one
// place in depth.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/camera/stereo_rig.h"
#include "engine/image/plane.h"

namespace stereonav {

// Continuous pixels of each eye's picture, (0, 0) its top left corner.
struct EyeMark {
    glm::dvec2 left{0.0}, right{0.0};
};

// A place of the left eye's picture, shares of its size, on the surface that is seen there (viewDepth: of the
// left eye); in the plane of the screen where nothing is hit or known, or the place lies beside the picture.
// guard: pixels of viewDepth at each side that lie beyond the picture.
EyeMark markUnder(const StereoViews& views, const Plane<float>& viewDepth, const glm::dvec2& share,
                  const glm::ivec2& guard = glm::ivec2(0));

// The point of the surface that markUnder() finds: that of the middle of viewDepth's pixel there. None where
// nothing is hit or known, or the place lies beside the picture.
std::optional<glm::dvec3> worldUnder(const StereoViews& views, const Plane<float>& viewDepth,
                                     const glm::dvec2& share, const glm::ivec2& guard = glm::ivec2(0));

struct PointMark {
    EyeMark mark;
    double depth = 0;  // of the view, metres
};
// A point of the world, where it is seen over a round Earth. None where it is nearer than the eyes see or
// behind them, outside the picture of one of them, or behind what is seen there.
std::optional<PointMark> markOf(const StereoViews& views, const Plane<float>& viewDepth,
                                const glm::dvec3& world, const glm::ivec2& guard = glm::ivec2(0));

}  // namespace stereonav
