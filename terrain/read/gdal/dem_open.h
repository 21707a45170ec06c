// Opens an elevation model by name: a file, or a folder of files that form one ground.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrain/read/gdal/gdal_session.h"

namespace stereonav {

// An elevation model that is open.
struct OpenedDem {
    GdalDataset dataset;
    std::vector<std::filesystem::path> files;  // files of a folder that form its ground
    std::vector<std::string> notes;            // guesses, for the user
};

// Opens an elevation model. For a folder it is a virtual raster over its elevation files
// (elevation_folder.h), without those that are no heights (folder_choice.h). They must have one reference
// system, stand north up, and mean their numbers alike; files on both sides of 180 degrees form one ground.
// The finest samples are used; files that are coarser, or not on the grid of the first, are resampled
// (bilinear). Where files overlap, the one whose name comes last is used, except for its missing samples;
// where there is no file, samples are missing. Missing values are those that each file names, or customary
// for its type, or an unnamed -9999 that lies far below all heights (HeightSamples::findCustomary(); where
// files overlap or are resampled, tested on some samples of each: hasDeepGround()). In netCDF files with
// several variables, the one named for heights is used. Throws Error that names the file that does not fit.
OpenedDem openDem(const std::filesystem::path& place, const GdalMessages& messages);

// Returns the dataset thinned to at most `most` samples, at least 2 in each direction, as a virtual raster
// over it: one of every few samples, or from its overviews where it has them. It must be closed before
// `whole`. Returns null where it has no more samples than that, and for text files, in which rows are found
// only by reading all before them. Throws Error.
GdalDataset thinnedDem(GDALDataset& whole, long long most, const std::filesystem::path& place);

// Returns whether the file is a text file, in which rows are found only by reading all before them.
bool isTextGrid(GDALDataset& dataset);

// Returns the first file of such a folder that can not be read to its end; "" where there is none, or the
// path is no folder.
std::filesystem::path damagedFileIn(const std::filesystem::path& folder);

}  // namespace stereonav
