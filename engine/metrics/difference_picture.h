// Pictures that show where a right eye was cast and where it is off (Wan et al. 2004, fig. 6c, 6e).
#pragma once

#include <cstdint>

#include "engine/image/eye_image.h"

namespace stereonav {

// The picture with red where the mask is set.
Plane<PackedColor> holesInRed(const Plane<PackedColor>& image, const Plane<std::uint8_t>& holeMask);

// |image - truth| a channel on sRGB bytes, times `factor`, black where they agree.
Plane<PackedColor> differenceTimes(const Plane<PackedColor>& truth, const Plane<PackedColor>& image,
                                   int factor);

}  // namespace stereonav
