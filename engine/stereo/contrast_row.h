// The contrast around each pixel, which predicts the error of a warped pixel. One row as plain pointers,
// since the kernel is compiled once for each instruction set.
#pragma once

#include <cstdint>

namespace stereonav {

// Contrast classes: 0 for none, then four to an octave of the largest difference of a channel (of 1023) from
// the four neighbours that are known.
constexpr int kContrastClasses = 41;
constexpr std::uint8_t kNoContrast = 255;  // the class of a hole

// Three rows that the kernel reads, and the classes that it writes.
struct ContrastRow {
    // Packed colours, and 255 where a colour is unknown. At the picture's border the row itself stands for
    // the missing one.
    const std::uint32_t *above, *row, *below;
    const std::uint8_t *holesAbove, *holes, *holesBelow;
    std::uint8_t* classes;  // output: the class of each pixel
    int width;              // >= 1
};

// Finds the classes of one row.
using ContrastFunction = void (*)(const ContrastRow&);
// Returns the fastest function that this processor can run.
ContrastFunction fastestContrast();

}  // namespace stereonav
