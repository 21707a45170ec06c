// How the files of a folder lie to each other, and what an unnamed -9999 of them is once they are mixed.
#pragma once

#include <vector>

#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/height_band.h"

namespace stereonav {

// Where a file's samples are, in its reference system; north up.
struct FilePlan {
    double west = 0, north = 0, east = 0, south = 0;  // outer borders
    double width = 1, height = 1;                     // size of a sample
    double turned = 0;                                // added to the file's own west

    explicit FilePlan(GDALDataset& dataset);
};

// Files of a system that closes around a body after `turn`, 360 degrees, and whose two ends are both among
// them: moves those of one end by a turn beside those of the other. Returns false where they lie together as
// they are.
bool turnTogether(std::vector<FilePlan*>& plans, double turn);

// Returns whether samples of one file are resampled to lie among those of another, or take their place: files
// overlap by more than half a sample, or are not on one grid.
bool filesAreMixed(const std::vector<FilePlan>& plans);

// Returns whether the file has ground so low that a -9999 may be a height there, as
// HeightSamples::findCustomary() has it: by 64 x 64 of its samples, as nothing but reading all of it would
// tell more.
bool hasDeepGround(GDALDataset& dataset, const HeightBand& band);

}  // namespace stereonav
