// The surface under a place of the picture that is shown, also while that is warped from another view.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/camera/stereo_rig.h"
#include "engine/image/plane.h"

namespace stereonav {

// Returns the world place on the surface that the left eye shows at `share` of its picture, from the depths
// of a picture that was cast a moment ago: exact where both views are one, else by iteration. Returns nothing
// where nothing was hit there. cast: the views of viewDepth; guard: its pixels on each side that lie outside.
std::optional<glm::dvec3> surfaceUnder(const StereoViews& shown, const StereoViews& cast,
                                       const Plane<float>& viewDepth, const glm::dvec2& share,
                                       const glm::ivec2& guard);

}  // namespace stereonav
