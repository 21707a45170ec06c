// PNG pictures by libpng alone: OpenCV brings 140 other libraries with it, GDAL and GDCM among them.
#pragma once

#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Returns the bytes of a PNG file (ISO/IEC 15948): 8-bit sRGB, row 0 at the top. Throws Error where the image
// is not at least 1 x 1, and where memory is short.
std::vector<unsigned char> pngBytes(const Plane<PackedColor>& image);

}  // namespace stereonav
