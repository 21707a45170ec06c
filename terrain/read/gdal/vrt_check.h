// Virtual rasters (.vrt) put other files together, which may lie anywhere: what one names is looked at before
// it is opened.
#pragma once

#include <filesystem>
#include <vector>

namespace stereonav {

// Whether the path is of another machine, or of GDAL's virtual file systems ("/vsicurl/...", "https://..."),
// also after a folder was put before it.
bool namesNetwork(const std::filesystem::path& path);

// Throws Error named by `file` unless it is no virtual raster, or all that it names, and so on, are local
// files of the formats read here.
void checkVirtualRaster(const std::filesystem::path& file);

// All files that it names, and so on; none where it is no virtual raster. Throws Error as
// checkVirtualRaster().
std::vector<std::filesystem::path> filesOfVirtualRaster(const std::filesystem::path& file);

// nullptr-terminated; of formats that hold their data themselves, and VRT.
const char* const* rasterDrivers();

}  // namespace stereonav
