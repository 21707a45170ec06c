// Missing samples of a height grid, filled smoothly from the border of each hole.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/base/progress.h"

namespace stereonav {

// Counts NaN and infinite samples.
long long countMissing(const std::vector<float>& heights);

// Replaces every NaN by the membrane through the known samples (Laplace's equation with the known samples
// fixed; the grid's border is free, so that a gap at the border continues level). Results lie within the
// range of the samples around; ramps are continued. spacing: metres. The same on every run and thread count.
// Returns the number of filled samples. Leaves a grid without a finite sample as it is. Throws Error where
// memory does not suffice; Cancelled.
long long fillMissing(std::vector<float>& heights, int width, int height, const glm::dvec2& spacing,
                      Progress& progress);

// Fills each NaN with fillMissing()'s first guess: averages of known samples around, over a wider area where
// these are farther away. Smooth, but ramps are not continued. A grid without a finite sample stays as it is.
void guessMissing(std::vector<float>& heights, int width, int height);

}  // namespace stereonav
