// A sweep's picture of one eye, before it is packed: linear light.
#pragma once

#include <glm/vec4.hpp>

#include "engine/image/eye_image.h"
#include "engine/image/plane.h"

namespace stereonav {

struct MediumPicture {
    // Linear RGB radiance, the background not in it, and in w the share of the background that is seen.
    Plane<glm::vec4> light;
    // View depth, metres, at which the eye's ray first meets something not empty, kMissDepth where nothing.
    Plane<float> viewDepth;
};

}  // namespace stereonav
