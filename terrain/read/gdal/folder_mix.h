// How the files of a folder lie relative to each other, and the meaning of an unnamed -9999 once they are
// mixed.
#pragma once

#include <vector>

#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/height_band.h"

namespace stereonav {

// The extent of a file's samples in its reference system, north up.
struct FilePlan {
    double west = 0, north = 0, east = 0, south = 0;  // outer borders
    double width = 1, height = 1;                     // size of a sample
    double turned = 0;                                // shift that is added to the file's own west

    explicit FilePlan(GDALDataset& dataset);
};

// For a reference system that closes around a body after `turn`, 360 degrees: where files lie at both of its
// ends, moves those at one end by a turn, beside those at the other. Returns false where nothing had to be
// moved.
bool turnTogether(std::vector<FilePlan*>& plans, double turn);

// Returns whether samples of one file are resampled to fit those of another, or replace them: files overlap
// by more than half a sample, or are not on one grid.
bool filesAreMixed(const std::vector<FilePlan>& plans);

// Returns whether the file has ground so low that -9999 may be a height there, in the sense of
// HeightSamples::findCustomary(). Tests 64 x 64 of its samples; only reading all could tell more.
bool hasDeepGround(GDALDataset& dataset, const HeightBand& band);

}  // namespace stereonav
