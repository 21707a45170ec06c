// A transfer function's integrals over values, as kernels read them: plain numbers and pointers only.
#pragma once

#include <cstdint>

namespace stereonav {

// Integrals of the extinction e and of e times red, green and blue over the values up to some value. The
// mean of e between two values is the difference of its integrals by that of the values, however far they lie
// apart: the integral functions of Engel, Kraus and Ertl (2001). They leave out that a piece of a ray hides
// its own far end; ours are short.
struct IntegralData {
    static constexpr int kEntries = 1024;  // between the function's ends; one more before, one behind
    static constexpr int kWords = 8;       // words an entry: two for each of the four integrals
    // By entry and integral: up to the entry's begin, in whole numbers of `quantum`; the mean over the entry,
    // a metre, single precision. Whole numbers: what is left of the difference of two large ones is exact.
    const std::uint32_t* table = nullptr;
    float scale = 0, offset = 0;    // place in entries = (value less the isovalue) * scale + offset
    float quantum = 0;              // entries a metre
    float lowest = 0, highest = 0;  // places between which something is not transparent
};

}  // namespace stereonav
