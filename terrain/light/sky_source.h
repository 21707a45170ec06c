// The sky from where a scene says: the built-in gradient, a picture, or a light probe.
#pragma once

#include <filesystem>
#include <string>

#include "engine/light/skies/sky_map.h"

namespace stereonav {

struct SkySource {
    SkyMap map;
    std::string source;  // what it is, in words
};

// Reads a sky. file: "" for the gradient. A picture twice as wide as high (to 2 %) is the whole sphere; any
// other is a panorama around the upper half, from the zenith (top row) to the horizon (bottom row), and its
// bottom row goes on below. The middle column lies north, columns to the right of it east. A .hdr light probe
// is brought into [0, 1] by Reinhard et al. 2002, eq. 4, with key 0.18 over the logarithmic mean of the
// sphere and white at the 99.5th percentile. Throws Error.
SkySource readSky(const std::filesystem::path& file);

}  // namespace stereonav
