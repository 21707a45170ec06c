// Radiance pictures (.hdr, .pic): light probes with shared exponents. Read here and not by the image
// library, which prints to the terminal when a file is damaged.
#pragma once

#include <string>
#include <string_view>

#include "engine/image/image_file.h"

namespace stereonav {

// Returns a file's picture from its bytes: linear RGB, row 0 at the top. Format 32-bit_rle_rgbe, rows from
// the top and columns from the left; flat, old and new run lengths. Throws Error with file and place.
LinearImage radianceImageOf(std::string_view content, const std::string& file, const std::string& place);

}  // namespace stereonav
