// Elevation models from files, through GDAL: GeoTIFF, SRTM .hgt, USGS DEM, ESRI ASCII, DTED, 16-bit
// PNG, and the RGB-coded elevation tiles of the Geospatial Information Authority of Japan. Checked,
// in metres both ways, south row first; missing samples are left for nodata.h.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/georeference.h"

namespace stereonav {

struct DemGrid {
    int width = 0, height = 0;     // samples, each >= 2
    glm::dvec2 spacing{1.0};       // metres
    std::vector<float> heights;    // metres times the vertical scale; row 0 southernmost; NaN: missing
    std::string driver;            // "GeoTIFF", ...
    std::string crs;               // name of the source's reference system, "" when it has none
    std::string projection;        // how it was brought to metres
    glm::dvec2 sourceOffset{0.0};  // reference x, y of the grid's middle
    long long sourceMissing = 0;   // missing samples of the file itself, before any resampling
    long long outside = 0;         // samples of the grid that lie beyond the file's own: missing too

    bool georeferenced = false;  // whether the file says where it lies
    Georeference source;         // of the file's samples
    Georeference grid;           // of these samples, north up; the same as source unless resampled
};

// A sample is missing where it is the file's nodata value, masked, NaN, infinite, or beyond 1e7 m.
// Degrees, feet, turned rasters and projections whose scale is off by more than 1 % (web Mercator)
// are brought to metres. Without a georeference a sample is a metre wide, except for a GSI tile:
// spacing from a path that ends in zoom/x/y.png, else that of zoom 14 at 36 degrees north.
// Throws Error named by the file; Cancelled.
DemGrid readDem(const std::filesystem::path& file, double verticalScale, Progress& progress);

}  // namespace stereonav
