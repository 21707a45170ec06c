// The shape of the generated terrain: mountains raised and cut by rivers until both balance. Its
// colour (built_in_color.h) is made from what the water left: drainage and distance to rivers.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/progress.h"

namespace stereonav {

struct Relief {
    int size = 0;                      // samples a side
    float spacing = 0;                 // metres between samples
    std::vector<float> heights;        // metres, row 0 southernmost, size * size as all below
    std::vector<float> drainage;       // square metres of ground whose water passes the sample
    std::vector<float> riverDistance;  // to the nearest river, in half widths of its valley floor; 4: far
};

// The side of every generated terrain, metres, whatever its number of samples.
constexpr float kBuiltInExtent = 15360.0f;

// Makes mountains of a seed, kBuiltInExtent a side, size x size samples, the lowest 0 m high. Throws
// Cancelled.
Relief makeRelief(std::uint64_t seed, int size, Progress& progress);

}  // namespace stereonav
