// The late warp in its plain form, for tests: every ray followed in quarters of a pixel through all depths,
// in double precision.
#pragma once

#include <cstdint>

#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"

namespace stereonav {

// Does what LateEye::prepare and warp do, slowly.
void warpLatePlainly(const Plane<PackedColor>& color, const Plane<float>& depth, const EyeView& from,
                     const EyeView& to, Plane<PackedColor>& image, Plane<std::uint8_t>& uncovered);

}  // namespace stereonav
