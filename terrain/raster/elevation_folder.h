// A folder whose elevation files form one ground.
#pragma once

#include <filesystem>
#include <vector>

namespace stereonav {

// Returns the files of a folder that have an extension of elevation models (.tif, .tiff, .hgt, .dem, .asc,
// .dt0, .dt1, .dt2, .img, .bil, .flt, .bt, .nc, .hgt.zip, .hgt.gz), sorted by name, without hidden files and
// subfolders. Empty where it is no folder.
std::vector<std::filesystem::path> elevationFilesIn(const std::filesystem::path& folder);

// Returns whether the file is a packed SRTM tile as distributed, N35E138.hgt.zip or .hgt.gz, which is read
// without unpacking it to disk.
bool isPackedHeights(const std::filesystem::path& file);

}  // namespace stereonav
