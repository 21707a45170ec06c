// Estimates how likely a raster's numbers are heights, and whether two rasters show the same ground.
#pragma once

#include <string>
#include <vector>

#include "terrain/read/gdal/folder_choice.h"

namespace stereonav {

// The sum of evidence for (above 0) and against heights, and the strongest argument against.
struct HeightEvidence {
    double score = 0;
    std::string against;  // "its name", "bytes"
    double rough = 0;     // mean step from sample to sample, as a share of their spread; 0: not known
};
// Returns the evidence. dataset: of the file; some of its samples are read.
HeightEvidence evidenceOf(GDALDataset& dataset, const FolderFile& file);

// Returns whether both rasters have samples at the same places that can not be heights of one ground: neither
// close to each other nor the same relief with another zero. Tests at most 32 x 32 places.
bool isOtherGround(GDALDataset& a, const FolderFile& fileA, GDALDataset& b, const FolderFile& fileB);

}  // namespace stereonav
