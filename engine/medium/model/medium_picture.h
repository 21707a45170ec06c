// A sweep's picture of one eye, before it is packed: linear light.
#pragma once

#include <glm/vec4.hpp>

#include "engine/image/eye_image.h"
#include "engine/image/plane.h"

namespace stereonav {

struct MediumPicture {
    // Linear RGB radiance without the background; w: share of the background that is seen.
    Plane<glm::vec4> light;
    // View depth in metres at which the ray first meets the medium; kMissDepth where it meets nothing.
    Plane<float> viewDepth;
};

}  // namespace stereonav
