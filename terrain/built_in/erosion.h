// Landscape evolution: uplift against rivers that cut and slopes that slide (stream power with talus).
#pragma once

#include <cstdint>
#include <vector>

namespace stereonav {

// A square grid of ground under evolution; all planes are size * size, row by row. The outermost
// samples are the base level: they stay as they are.
struct Landscape {
    int size = 0;
    float spacing = 0;                   // metres between samples
    std::vector<float> height;           // metres, >= 0
    std::vector<float> uplift;           // metres a unit of time
    std::vector<float> talus;            // steepest slope that stands, metres a metre
    std::vector<float> drainage;         // out: square metres upstream
    std::vector<std::int32_t> receiver;  // out: sample that the water goes to; at the border itself
};

// Raises every depression just above its outlet, so that all water reaches the border.
// Priority-Flood+epsilon of Barnes, Lehman and Mulla, Computers & Geosciences 62 (2014), algorithm 3.
void fillDepressions(Landscape& land);

// Takes one step of time dt, in the unit of time of `uplift`, with an erodibility per that unit: the
// implicit, unconditionally stable scheme of Braun and Willett, Geomorphology 180 (2013), section 3.4, for
// slope exponent 1 and area exponent 1/2. Differs: samples are ordered by sorting their heights, slopes are
// cut to the talus in the same sweep, and steepest descent is perturbed (by `seed`) so that rivers do not
// follow the eight directions of the grid. The ground must have no depressions, and has none afterwards.
void erode(Landscape& land, float dt, float erodibility, std::uint64_t seed);

}  // namespace stereonav
