// A folder whose elevation files are one ground.
#pragma once

#include <filesystem>
#include <vector>

namespace stereonav {

// Returns the files of a folder whose extension is one of elevation models (.tif, .tiff, .hgt, .dem, .asc,
// .dt0, .dt1, .dt2, .img, .bil, .flt, .bt, .nc, .hgt.zip, .hgt.gz), sorted by name; hidden ones, and those in
// folders of it, do not count. Returns nothing where it is no folder.
std::vector<std::filesystem::path> elevationFilesIn(const std::filesystem::path& folder);

// Returns whether the file is an SRTM tile as it is distributed, N35E138.hgt.zip or .hgt.gz, which is read
// without unpacking.
bool isPackedHeights(const std::filesystem::path& file);

}  // namespace stereonav
