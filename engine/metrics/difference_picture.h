// Pictures that show where a right eye was cast and where it is off (Wan et al. 2004, fig. 6c, 6e).
#pragma once

#include <cstdint>

#include "engine/image/eye_image.h"

namespace stereonav {

// Returns the picture with red where the mask is set. Throws Error where their sizes differ.
Plane<PackedColor> holesInRed(const Plane<PackedColor>& image, const Plane<std::uint8_t>& holeMask);

// Returns |image - truth| a channel on sRGB bytes, times `factor`, black where they agree. Throws Error where
// their sizes differ.
Plane<PackedColor> differenceTimes(const Plane<PackedColor>& truth, const Plane<PackedColor>& image,
                                   int factor);

}  // namespace stereonav
