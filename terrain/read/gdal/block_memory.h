// Memory for reading rasters by blocks. The file chooses their size, so that a small file may have a block of
// gigabytes.
#pragma once

#include <string>

class GDALDataset;

namespace stereonav {

// Returns the bytes that GDAL takes to read a block of any band, overview or mask: the block of all
// interleaved bands, and that band's own; for formats that unpack all pixels at once, all of them. format:
// the driver's name.
double bytesOfBlock(GDALDataset& dataset, const std::string& format);

// Throws Error that names `name` where bytesOfBlock() is more than the available memory.
void checkBlocks(GDALDataset& dataset, const std::string& format, const std::string& name);

}  // namespace stereonav
