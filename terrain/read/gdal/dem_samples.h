// The samples of an elevation raster as stored: missing values found, units and scale applied.
// The first part of readDem(); the others place them on a grid in metres.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/read/gdal/gdal_session.h"

namespace stereonav {

// Whether the raster is a GSI elevation tile: 256x256, three or four 8-bit bands, not JPEG, and every
// pixel decodes to a height between -500 and 9,000 m or to nodata; a photo does not.
bool isGsiTile(GDALDataset& dataset);

struct DemSamples {
    std::vector<float>
        heights;  // metres times the vertical scale, in the raster's own row order, NaN where missing
    // What the file left to be found out, in words for a person; "" where there is nothing to say.
    std::string band;     // which of several bands
    std::string unit;     // of the heights, where they are not plain metres
    std::string missing;  // what marks missing samples
};

// Throws Error when the raster holds no elevations, can not be read, or its heights times the vertical scale
// are beyond what floats hold (height_limits.h); Cancelled.
DemSamples readSamples(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                       double verticalScale, Progress& progress);

}  // namespace stereonav
