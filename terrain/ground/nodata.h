// Missing samples of a height grid, filled smoothly from the border of each hole.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/base/progress.h"

namespace stereonav {

// Counts NaN and infinite samples.
long long countMissing(const std::vector<float>& heights);

// Replaces every NaN by the membrane through the known samples (Laplace's equation with the known samples
// fixed; the grid's own border is free, so a gap at the border goes on level). It stays within the range of
// the samples around it and continues ramps. spacing: metres. The same on every run and thread count. Returns
// how many it filled. Leaves a grid alone that has no finite sample. Throws Error where memory does not
// suffice; Cancelled.
long long fillMissing(std::vector<float>& heights, int width, int height, const glm::dvec2& spacing,
                      Progress& progress);

// Fills each NaN with what fillMissing() begins with: averages of the known samples around, the wider the
// farther these are. Smooth, but it does not continue ramps. A grid without a finite sample is left alone.
void guessMissing(std::vector<float>& heights, int width, int height);

}  // namespace stereonav
