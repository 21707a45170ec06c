// How much the colours around a pixel differ: by what the error of a warped pixel is predicted. One row as
// plain pointers, since the kernel is compiled once for each instruction set.
#pragma once

#include <cstdint>

namespace stereonav {

// Contrast classes: 0 for none, then four to an octave of the largest difference of a channel (of 1023) from
// the four neighbours that are known.
constexpr int kContrastClasses = 41;
constexpr std::uint8_t kNoContrast = 255;  // the class of a hole

// Three rows that the kernel reads, and the classes that it writes.
struct ContrastRow {
    const std::uint32_t *above, *row, *below;             // packed colours; at the border the row itself
    const std::uint8_t *holesAbove, *holes, *holesBelow;  // 255 where nothing is known; the same
    std::uint8_t* classes;                                // each pixel's
    int width;                                            // >= 1
};

// Finds the classes of one row.
using ContrastFunction = void (*)(const ContrastRow&);
// Returns the function for the processor at hand.
ContrastFunction fastestContrast();

}  // namespace stereonav
