// A raster to be written: one band over a terrain's samples.
#pragma once

#include <cstdint>
#include <string>

#include "engine/image/plane.h"

namespace stereonav {

// The values, in one of two planes with row 0 southernmost, and their description.
struct WrittenRaster {
    const Plane<std::uint8_t>* bytes = nullptr;
    const Plane<float>* floats = nullptr;
    double missing = 0;       // value of samples that are not known, in `unit`
    std::string description;  // description of the band
    std::string unit;         // unit of the band's values
};

}  // namespace stereonav
