// Elevation models from files, through GDAL: GeoTIFF, SRTM .hgt, USGS DEM, ESRI ASCII, DTED, netCDF, 16-bit
// PNG, and RGB-coded elevation tiles: of the Geospatial Information Authority of Japan, Terrain-RGB and
// Terrarium. Samples are checked and brought to metres in all directions, south row first; missing ones are
// left for nodata.h.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/raster/georeference.h"

namespace stereonav {

// Largest number of samples that are read at once: per side, and in total.
constexpr int kMostDemSide = 65536;
constexpr long long kMostDemSamples = 1ll << 28;

struct DemGrid {
    int width = 0, height = 0;     // samples, each >= 2
    glm::dvec2 spacing{1.0};       // metres
    std::vector<float> heights;    // metres times the vertical scale; row 0 southernmost; NaN: missing
    std::string driver;            // "GeoTIFF", ...
    std::string crs;               // name of the source's reference system, "" when it has none
    std::string projection;        // how the samples were brought to a grid in metres
    std::string verticalDatum;     // datum of heights, as the file names it; "" where it does not
    glm::dvec2 sourceOffset{0.0};  // reference x, y of the grid's middle, units of the source
    // Metres per unit of sourceOffset; 0: it is in another system than the source's own.
    double sourceUnit = 0;
    long long sourceMissing = 0;  // missing samples of the file itself, before any resampling
    long long outside = 0;        // samples of the grid outside the file's area: missing too
    // Mean radius in metres of the body that the reference system belongs to; 0 where it names none.
    double bodyRadius = 0;

    // Guesses about what the file does not say, in words; "" where there was nothing to guess.
    std::string band;                // the band that was read, of several
    std::string heightUnit;          // the unit of the heights, where it is not plain metres
    std::string missingValue;        // what marks missing samples
    std::vector<std::string> notes;  // other guesses and omissions, a line each, with the file's name

    bool georeferenced = false;  // whether the file says where it lies
    Georeference source;         // place of the file's own samples
    Georeference grid;           // place of these samples, north up; the same as source unless resampled
};

// Returns the bytes that a caller will hold at once for `samples` samples, including the heights.
using BytesForSamples = std::function<double(double samples)>;
// Reads an elevation model. verticalScale: factor on the heights. A sample is missing where it has the file's
// nodata value, or, if the file names none, a customary value (-32768 in 16 bits; -9999 where that is far
// below all others), where it is masked, NaN, infinite, or beyond 1e7 m. Of several bands the one whose names
// are about heights is read. Heights are in the band's unit, else in that of the vertical reference system,
// else metres. Degrees, feet, rotated rasters, control points and projections whose scale is off by more than
// 1 % (web Mercator) are converted to metres; over a pole the file's projection stays. Where the band or the
// vertical axis counts downward, heights change their sign. Without a georeference a sample is a metre wide,
// except for a coded tile: its spacing follows from a path that ends in zoom/x/y.png, else it is that of zoom
// 14 at 36 degrees north. after: bytes that the caller needs next; nothing is read where these, or those for
// reading, do not fit into the available memory. Throws Error that names the file; Cancelled.
DemGrid readDem(const std::filesystem::path& file, double verticalScale, Progress& progress,
                const BytesForSamples& after = {});

// Facts from the file's header, without its samples.
struct DemGlance {
    int width = 0, height = 0;                                // samples of the file
    glm::dvec2 step{1.0};                                     // distance between samples, in `unit`
    std::string unit;                                         // unit of the plan: "m", "degrees", "units"
    std::string driver, crs, band, heightUnit, missingValue;  // DemGrid's
    std::string type;                                         // type of a sample, as GDAL calls it: "Int16"
};
// Reads the header. Throws Error as readDem() does where the header is enough to refuse it.
DemGlance glanceAtDem(const std::filesystem::path& file);

}  // namespace stereonav
