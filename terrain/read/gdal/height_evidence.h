// How likely a raster's numbers are heights, and whether two rasters have the same ground.
#pragma once

#include <string>
#include <vector>

#include "terrain/read/gdal/folder_choice.h"

namespace stereonav {

// Evidence for heights (above 0) and against them, added up, and the strongest word against them.
struct HeightEvidence {
    double score = 0;
    std::string against;  // "its name", "bytes"
    double rough = 0;     // mean step from sample to sample, as a share of how far they spread; 0: not known
};
// dataset: of the file. Reads some of its samples.
HeightEvidence evidenceOf(GDALDataset& dataset, const FolderFile& file);

// Returns whether both have samples at the same places, and these are not heights of one ground: neither near
// each other nor the same relief with another zero. By 32 x 32 places at most.
bool isOtherGround(GDALDataset& a, const FolderFile& fileA, GDALDataset& b, const FolderFile& fileB);

}  // namespace stereonav
