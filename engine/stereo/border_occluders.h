// Region V of Wan et al. 2004, fig. 2: objects near the right border that only the right eye sees, in front
// of the surfaces that were warped there. Marks the pixels where the scene can not rule them out.
#pragma once

#include <cstdint>

#include "engine/camera/stereo_rig.h"
#include "engine/image/plane.h"
#include "engine/render/eye_renderer.h"

namespace stereonav {

// Makes holes (mask 255, colour and view depth 0) in tiles that may show such an object. Runs on all threads.
void markBorderOccluders(const EyeRenderer& renderer, const StereoViews& views, Plane<std::uint8_t>& mask,
                         EyeImage& right);

}  // namespace stereonav
