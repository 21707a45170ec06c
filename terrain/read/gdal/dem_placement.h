// The place of an elevation raster, and the conversion of its samples to a grid in metres, from the header of
// its file. Shared by readDem(), glanceAtDem() and DemRows.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <string>

#include "terrain/raster/georeference.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/gdal/dem_open.h"
#include "terrain/read/gdal/gdal_session.h"

namespace stereonav {

// Fills in driver, crs, datum, body, source, georeferenced and notes. dataset: opened.dataset, or a thinned
// one. Throws Error that names the file where its samples have no valid place or are less than 2x2.
void describeSource(GDALDataset& dataset, const OpenedDem& opened, const std::filesystem::path& file,
                    DemGrid& dem);

struct DemPlacement {
    // Samples stay as they are, at most with reversed rows or columns; else they are resampled.
    bool asTheyAre = false;
    Georeference grid;          // grid of the placed samples, north up and east right
    bool westward = false;      // where asTheyAre: rows of the file run from east to west
    bool southFirst = false;    // where asTheyAre: the file's first row is the southernmost
    double ownUnit_m = 0;       // metres on the ground per unit of their own plane; 0: they leave that plane
    bool staysInPlane = false;  // they stay in their plane, even if resampled
    std::string stretch;        // stretch of the plane over a pole, in words
};

// Chooses the placement. Throws Error that names the file where there is no conversion to metres or the grid
// is beyond the limits.
DemPlacement placementOf(const Georeference& source, const std::filesystem::path& file,
                         const RasterLimits& limits);

// Fills in the members that follow from the placement: grid, sizes, spacing, projection, offset and unit.
void placeOnGrid(const DemPlacement& placement, DemGrid& dem);

}  // namespace stereonav
