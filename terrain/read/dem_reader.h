// Elevation models from files, through GDAL: GeoTIFF, SRTM .hgt, USGS DEM, ESRI ASCII, DTED, netCDF, 16-bit
// PNG, and RGB-coded elevation tiles: of the Geospatial Information Authority of Japan, Terrain-RGB and
// Terrarium. Checked, in metres both ways, south row first; missing samples are left for nodata.h.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/raster/georeference.h"

namespace stereonav {

// The most samples that are read at once: a side, and in all.
constexpr int kMostDemSide = 65536;
constexpr long long kMostDemSamples = 1ll << 28;

struct DemGrid {
    int width = 0, height = 0;     // samples, each >= 2
    glm::dvec2 spacing{1.0};       // metres
    std::vector<float> heights;    // metres times the vertical scale; row 0 southernmost; NaN: missing
    std::string driver;            // "GeoTIFF", ...
    std::string crs;               // name of the source's reference system, "" when it has none
    std::string projection;        // how it was brought to metres
    std::string verticalDatum;     // datum of heights, as the file names it; "" where it does not
    glm::dvec2 sourceOffset{0.0};  // reference x, y of the grid's middle, units of the source
    double sourceUnit = 0;        // metres of a unit of sourceOffset; 0: it is not in the source's own system
    long long sourceMissing = 0;  // missing samples of the file itself, before any resampling
    long long outside = 0;        // samples of the grid that lie beyond the file's own: missing too
    // Mean radius, metres, of the body that its reference system belongs to; 0 where it names none.
    double bodyRadius = 0;

    // Guesses about things that the file does not say, in words; "" where there is nothing to say.
    std::string band;                // the band that was read, of several
    std::string heightUnit;          // where heights were not plain metres
    std::string missingValue;        // what marks missing samples
    std::vector<std::string> notes;  // what else was guessed or left aside, a line each, with the file's name

    bool georeferenced = false;  // whether the file says where it lies
    Georeference source;         // place of the file's samples
    Georeference grid;           // place of these samples, north up; the same as source unless resampled
};

// Returns the bytes that a caller will hold at once for `samples` samples, the heights among them.
using BytesForSamples = std::function<double(double samples)>;
// Reads an elevation model. verticalScale: factor on the heights. A sample is missing where it is the file's
// nodata value, or without one what is customary (-32768 of 16 bits, -9999 far below all else), masked, NaN,
// infinite, or beyond 1e7 m. Of several bands the one that speaks of heights counts. Heights are in the
// band's unit, else in that of the vertical reference system, else metres. Degrees, feet, turned rasters,
// control points and projections whose scale is off by more than 1 % (web Mercator) are brought to metres;
// over a pole the file's projection stays. Where the band or the vertical axis counts downward heights are
// turned over. Without a georeference a sample is a metre wide, except for a coded tile: spacing from a path
// that ends in zoom/x/y.png, else that of zoom 14 at 36 degrees north. Throws Error that names the file;
// Cancelled. after: where what it gives, or what reading takes, does not fit into the memory that can be had,
// nothing is read.
DemGrid readDem(const std::filesystem::path& file, double verticalScale, Progress& progress,
                const BytesForSamples& after = {});

// Facts from the file's header; no sample is read.
struct DemGlance {
    int width = 0, height = 0;                                // samples of the file
    glm::dvec2 step{1.0};                                     // between samples, in `unit`
    std::string unit;                                         // unit of the plan: "m", "degrees", "units"
    std::string driver, crs, band, heightUnit, missingValue;  // DemGrid's
    std::string type;                                         // type of a sample, as GDAL calls it: "Int16"
};
// Reads the header. Throws Error as readDem() does where the header is enough to refuse it.
DemGlance glanceAtDem(const std::filesystem::path& file);

}  // namespace stereonav
