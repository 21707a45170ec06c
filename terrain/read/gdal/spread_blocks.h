// Decodes some blocks of a raster of heights, spread evenly over it: for files in which reading a few samples
// would decode nearly all blocks.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "terrain/read/dem_rows.h"
#include "terrain/read/gdal/dem_samples.h"

namespace stereonav {

// Returns whether any block of the format can be decoded without those before it.
bool hasBlocksAnywhere(GDALDataset& dataset);

// Returns `size` samples, each with the height nearest to its middle. At least kFewestSpread blocks are
// decoded, and as many as fit into the time; between them `fill` interpolates; NaN where most decoded samples
// nearby are missing. A -9999 that findCustomary() finds is missing. If all blocks are decoded no value is
// interpolated. Empty where a block has more than 2^24 samples or the fewest blocks would take more than
// most_ms. Throws Error for a file that is cut off, Cancelled.
constexpr int kFewestSpread = 64;
std::vector<float> readSpreadBlocks(HeightSamples& raster, GdalMessages& messages, const glm::ivec2& size,
                                    double time_ms, double most_ms, const FillBetween& fill);

}  // namespace stereonav
