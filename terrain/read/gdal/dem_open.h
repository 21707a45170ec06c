// Opens what an elevation model is named by: its file, or a folder of files that are one ground.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrain/read/gdal/gdal_session.h"

namespace stereonav {

// An elevation model that is open.
struct OpenedDem {
    GdalDataset dataset;
    std::vector<std::filesystem::path> files;  // files of a folder that are its ground
    std::vector<std::string> notes;            // what was guessed, for a person
};

// A virtual raster over a folder's elevation files (elevation_folder.h), but for what is no heights
// (folder_choice.h). They have one reference system, stand north up, and mean their numbers alike; where they
// lie on both sides of 180 degrees they are one ground. The finest samples count; files that are coarser, or
// not on the grid of the first, are resampled (bilinear). Where files overlap the one whose name comes last
// counts, but for its missing samples; where there is none samples are missing. Missing is what each file
// says, or its type's custom, or a -9999 that it does not name, where all heights lie far above that
// (HeightSamples::findCustomary(); where files overlap or are resampled by some samples of each:
// hasDeepGround()). Of netCDF files of several variables the one that is called heights. Throws Error that
// names the file that does not fit.
OpenedDem openDem(const std::filesystem::path& place, const GdalMessages& messages);

// Returns the dataset with at most `most` samples, at least 2 each way, as a virtual raster over it: one
// sample of each few, or of its overviews where it has them. It must be closed before `whole`. Returns null
// where all are no more than that, and where rows are found by reading all before them (text). Throws Error.
GdalDataset thinnedDem(GDALDataset& whole, long long most, const std::filesystem::path& place);

// Returns whether rows of the file are found by reading all before them.
bool isTextGrid(GDALDataset& dataset);

// The first file of such a folder that can not be read to its end; "" where there is none, or it is no
// folder.
std::filesystem::path damagedFileIn(const std::filesystem::path& folder);

}  // namespace stereonav
