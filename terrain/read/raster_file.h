// GDAL's functions for terrain, other than readDem(): pictures in files, and the relation of rasters to each
// other. The functions are in the module stereonav_gdal (terrain/read/gdal), which is loaded by the first
// call.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "terrain/raster/earth_places.h"
#include "terrain/raster/georeference.h"
#include "terrain/raster/ground_picture.h"
#include "terrain/raster/reference_places.h"
#include "terrain/raster/track_line.h"
#include "terrain/raster/written_raster.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/dem_rows.h"

namespace stereonav {

// The open file of a picture. For one thread.
class RasterPicture {
public:
    virtual ~RasterPicture() = default;
    // Returns the picture's place; sets `known` to whether the file has one (else a unit per pixel, without a
    // system).
    virtual Georeference georeference(bool& known) = 0;
    // Returns the tone for the whole picture, so that all its parts look alike: 16 bits of which few are used
    // are stretched, with a note. Throws Error.
    virtual PictureTone tone() = 0;
    // Returns the tone over the full range of its bits, whatever its pixels.
    virtual PictureTone wholeTone() = 0;
    // Reads the window, averaged down by the factor `shrink` (>= 1) each way. Throws Error.
    virtual GroundPicture read(const PixelWindow& window, const glm::dvec2& shrink,
                               const PictureTone& tone) = 0;
};

// Opens a picture. `expected` completes the sentence "expected ..." and `advice` says what to give instead.
// Throws Error.
std::unique_ptr<RasterPicture> openRasterPicture(const std::filesystem::path& file,
                                                 const std::string& expected, const std::string& advice);

// Maps pixels of `target` to those of `source`. Throws Error that names `file` where there is no conversion
// between the two reference systems.
PixelMap mapPixels(const Georeference& target, const Georeference& source, const std::filesystem::path& file);

// Returns whether the two rasters share ground. Throws Error as mapPixels does.
bool overlap(const Georeference& a, const Georeference& b, const std::filesystem::path& file);

// Returns the conversion from a world to places on the Earth; null where the grid's reference system is
// unknown or belongs to another body. grid: the world's grid, north up, with `spacing` metres per pixel; the
// world's origin is the grid's middle.
std::unique_ptr<EarthPlaces> earthPlaces(const Georeference& grid, const glm::dvec2& spacing);

// Returns the conversion from the same world to the reference system of the file, `source`, that the grid was
// made from. Null where there is no conversion between the two systems.
std::unique_ptr<ReferencePlaces> referencePlaces(const Georeference& source, const Georeference& grid,
                                                 const glm::dvec2& spacing);

// Writes a GeoTIFF over the grid's samples; the file is made anew. Throws Error.
void writeGeoTiff(const std::filesystem::path& file, const Georeference& grid, const WrittenRaster& raster);

// Reads the lines, areas and places of a GPX or GeoJSON file, at least one; areas without their holes, and
// tracks without their waypoints. Throws Error.
TrackFile readTrackFile(const std::filesystem::path& file);
// Reads the lines and areas of a file, at least one; the segments of a track become one line. Throws Error.
std::vector<TrackLine> readTracks(const std::filesystem::path& file);

// The module's functions, which the functions above call.
struct RasterFunctions {
    decltype(&stereonav::readDem) readDem;
    decltype(&stereonav::glanceAtDem) glanceAtDem;
    decltype(&stereonav::openDemRows) openDemRows;
    decltype(&stereonav::openRasterPicture) openRasterPicture;
    decltype(&stereonav::mapPixels) mapPixels;
    decltype(&stereonav::overlap) overlap;
    decltype(&stereonav::earthPlaces) earthPlaces;
    decltype(&stereonav::referencePlaces) referencePlaces;
    decltype(&stereonav::writeGeoTiff) writeGeoTiff;
    decltype(&stereonav::readTrackFile) readTrackFile;
};

}  // namespace stereonav
