// Where an elevation raster lies, and how its samples get to a grid in metres: what the header of its file
// says, known before a sample is read. Shared by readDem(), glanceAtDem() and DemRows.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <string>

#include "terrain/raster/georeference.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/gdal/dem_open.h"
#include "terrain/read/gdal/gdal_session.h"

namespace stereonav {

// Fills in driver, crs, datum, body, source, georeferenced and notes. dataset: opened.dataset, or thinned
// from it. Throws Error that names the file where its samples lie nowhere or are less than 2x2.
void describeSource(GDALDataset& dataset, const OpenedDem& opened, const std::filesystem::path& file,
                    DemGrid& dem);

struct DemPlacement {
    bool asTheyAre = false;  // whether samples stay as they are, turned over at most; else they are resampled
    Georeference grid;       // grid of the placed samples, north up and east right
    bool westward = false;   // where asTheyAre: rows of the file run from east to west
    bool southFirst = false;  // where asTheyAre: the file's first row is the southernmost
    double ownUnit_m = 0;  // metres on the ground in a unit of the plane that they lie in; 0: they leave it
    bool staysInPlane = false;  // whether they stay in their plane, also where they are resampled
    std::string stretch;        // stretch of the plane over a pole, in words
};

// Throws Error that names the file where there is no way to metres or the grid is beyond the limits.
DemPlacement placementOf(const Georeference& source, const std::filesystem::path& file,
                         const RasterLimits& limits);

// Fills in what follows from it: grid, sizes, spacing, projection, offset and unit.
void placeOnGrid(const DemPlacement& placement, DemGrid& dem);

}  // namespace stereonav
