// Some blocks of a raster of heights, spread evenly over it: for files that are decoded a block at a time, of
// which a few samples cost as much as all.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "terrain/read/dem_rows.h"
#include "terrain/read/gdal/dem_samples.h"

namespace stereonav {

// Returns whether the format gives any block without decoding those before.
bool hasBlocksAnywhere(GDALDataset& dataset);

// size: samples, each the nearest of the raster's to its middle. Those of the blocks that were decoded, as
// many as that time gives and kFewestSpread at least, and between them what `fill` gives; NaN where most of
// what was read nearby is missing. -9999 that findCustomary() finds is missing. All blocks: as they are. None
// where a block has more than 2^24 samples or the fewest take more than most_ms. Throws Error for a file
// that is cut off, Cancelled.
constexpr int kFewestSpread = 64;
std::vector<float> readSpreadBlocks(HeightSamples& raster, GdalMessages& messages, const glm::ivec2& size,
                                    double time_ms, double most_ms, const FillBetween& fill);

}  // namespace stereonav
