// A raster as it is written: one band over a terrain's samples.
#pragma once

#include <cstdint>
#include <string>

#include "engine/image/plane.h"

namespace stereonav {

// One of the two planes, row 0 southernmost, and what is written of it.
struct WrittenRaster {
    const Plane<std::uint8_t>* bytes = nullptr;
    const Plane<float>* floats = nullptr;
    double missing = 0;       // value of samples that are not known, in `unit`
    std::string description;  // description of the band
    std::string unit;         // unit of the band's values
};

}  // namespace stereonav
