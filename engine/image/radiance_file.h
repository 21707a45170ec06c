// Radiance pictures (.hdr, .pic): light probes with shared exponents. Read here and not by the image
// library, which prints to the terminal when a file is damaged.
#pragma once

#include <filesystem>

#include "engine/image/image_file.h"

namespace stereonav {

// Linear RGB, row 0 at the top. Format 32-bit_rle_rgbe, rows from the top and columns from the left;
// flat, old and new run lengths. At most 2^27 pixels. Throws Error with file and place.
LinearImage readRadianceImage(const std::filesystem::path& file);

}  // namespace stereonav
