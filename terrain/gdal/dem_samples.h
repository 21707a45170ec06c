// The samples of an elevation raster as stored: missing values found, units and scale applied.
// The first half of readDem(); its second half places them on a grid in metres.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/gdal/gdal_session.h"

namespace stereonav {

// Whether the raster is a GSI elevation tile: 256x256, three or four 8-bit bands, not JPEG, and every
// pixel decodes to a height between -500 and 9,000 m or to nodata; a photo does not.
bool isGsiTile(GDALDataset& dataset);

// Metres times verticalScale, in the raster's own row order, NaN where missing. Throws Error when the
// raster holds no elevations or can not be read; Cancelled.
std::vector<float> readSamples(GDALDataset& dataset, GdalMessages& messages,
                               const std::filesystem::path& file, double verticalScale, Progress& progress);

}  // namespace stereonav
