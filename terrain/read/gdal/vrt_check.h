// Virtual rasters (.vrt) put other files together, which may lie anywhere: what one names is looked at before
// it is opened.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stereonav {

// Names of virtual rasters that the program itself makes in memory begin so.
constexpr const char* kOwnVirtualRasters = "/vsimem/stereonav_part_";

// Returns whether the path is of another machine, or of GDAL's virtual file systems ("/vsicurl/...",
// "https://..."), also after a folder was put before it.
bool namesNetwork(const std::filesystem::path& path);

// Returns whether the file lies in the folder or below it, links followed; false where one of them is not
// there.
bool liesBelow(const std::filesystem::path& folder, const std::filesystem::path& file);

// The files that a virtual raster is made of, those that these are made of, and so on.
struct VirtualRasterFiles {
    std::vector<std::filesystem::path> all, outside;  // outside: not in the folder of the one that names them
};

// Returns the files; none where `file` is no virtual raster. Throws Error that names `file` unless all that
// it names, and so on, are local files of the formats read here, and files that are read as plain numbers lie
// in its folder or below.
VirtualRasterFiles filesOfVirtualRaster(const std::filesystem::path& file);

// One line on the files outside the folder; "" where there are none.
std::string outsideNote(const std::filesystem::path& file, const VirtualRasterFiles& files);

// Checks the file itself when GDAL opens it, whoever named it; not what its files are. Throws Error that
// names `file`.
void checkOpenedVirtualRaster(const std::filesystem::path& file);

// nullptr-terminated; of formats that hold their data themselves, and VRT.
const char* const* rasterDrivers();

}  // namespace stereonav
