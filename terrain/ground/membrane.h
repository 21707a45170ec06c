// Laplace's equation over the missing samples of a height grid: the solver behind fillMissing().
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/base/progress.h"

namespace stereonav {

// Solves for the samples `missing`, ascending indices; heights, metres, hold a first guess there and fixed
// values elsewhere, at least one. spacing: metres. The grid's border is free. About 90 bytes a missing sample
// while it runs; one thread, so the same bits on every run. Throws Cancelled.
void solveMembrane(const std::vector<std::size_t>& missing, std::vector<float>& heights, int width,
                   int height, const glm::dvec2& spacing, Progress& progress);

}  // namespace stereonav
