// Pictures embedded in HTML pages.
#pragma once

#include <span>
#include <string>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Returns the bytes as text, padded to a multiple of four letters (RFC 4648, section 4).
std::string base64(std::span<const unsigned char> bytes);

// Returns "data:image/png;base64,...", to stand as the address of a picture in HTML. image: at least 1 x 1.
// Throws as pngBytes() does.
std::string inlinePicture(const Plane<PackedColor>& image);

}  // namespace stereonav
