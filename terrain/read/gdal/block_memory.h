// Rasters are read by blocks, whose size is the file's to choose: a small file may have one of gigabytes.
#pragma once

#include <string>

class GDALDataset;

namespace stereonav {

// Bytes that GDAL takes to read a block of any band, overview or mask: the block of all bands that lie
// together, and that band's own; of formats that unpack all pixels at once all of them.
// format: the driver's name.
double bytesOfBlock(GDALDataset& dataset, const std::string& format);

// Throws Error that names `name` where that is more than can be had.
void checkBlocks(GDALDataset& dataset, const std::string& format, const std::string& name);

}  // namespace stereonav
