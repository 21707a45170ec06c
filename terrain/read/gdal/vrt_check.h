// Checks of virtual rasters (.vrt), which combine other files that may lie anywhere: the names in one are
// checked before it is opened.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stereonav {

// Prefix of virtual rasters that the program itself makes in memory.
constexpr const char* kOwnVirtualRasters = "/vsimem/stereonav_part_";

// Returns whether the path is on another machine, or in GDAL's virtual file systems ("/vsicurl/...",
// "https://..."), even with a folder in front of it.
bool namesNetwork(const std::filesystem::path& path);

// Returns whether the file lies in the folder or below it, after following links; false where one of them
// does not exist.
bool liesBelow(const std::filesystem::path& folder, const std::filesystem::path& file);

// The files that a virtual raster is made of, including the files of nested virtual rasters.
struct VirtualRasterFiles {
    // Outside: not in the folder of the raster that names them.
    std::vector<std::filesystem::path> all, outside;
};

// Returns the files; empty where `file` is no virtual raster. Throws Error that names `file` unless all files
// named in it, directly or indirectly, are local files in formats that are read here, and those read as raw
// numbers lie in its folder or below.
VirtualRasterFiles filesOfVirtualRaster(const std::filesystem::path& file);

// Returns one line about files outside the folder; "" where there are none.
std::string outsideNote(const std::filesystem::path& file, const VirtualRasterFiles& files);

// Checks the virtual raster itself when GDAL opens it, whatever file named it; does not check its sources.
// Throws Error that names `file`.
void checkOpenedVirtualRaster(const std::filesystem::path& file);

// Returns the drivers, nullptr-terminated: formats that hold their own data, and VRT.
const char* const* rasterDrivers();

}  // namespace stereonav
