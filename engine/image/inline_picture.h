// Pictures inside of pages.
#pragma once

#include <string>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Returns "data:image/png;base64,...", to stand as the address of a picture in HTML. Throws as pngBytes()
// does.
std::string inlinePicture(const Plane<PackedColor>& image);

}  // namespace stereonav
