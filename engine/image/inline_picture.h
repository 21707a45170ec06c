// Pictures inside of pages.
#pragma once

#include <string>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// "data:image/png;base64,...", to stand as the address of a picture in HTML. image: at least 1 x 1.
std::string inlinePicture(const Plane<PackedColor>& image);

}  // namespace stereonav
