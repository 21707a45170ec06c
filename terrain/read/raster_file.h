// What terrain asks of GDAL, beside readDem(): pictures in files, and where rasters lie to each other. The
// functions are those of the module stereonav_gdal (terrain/read/gdal), which is loaded by the first that is
// called.
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

// A picture's file, open. To one thread.
class RasterPicture {
public:
    virtual ~RasterPicture() = default;
    // Returns where it lies; sets `known` to whether the file says so (else a unit a pixel, no system).
    virtual Georeference georeference(bool& known) = 0;
    // Returns the tone that its pixels ask for, of all of it, so that its parts are shown alike: 16 bits that
    // are hardly used are stretched, and that is noted. Throws Error.
    virtual PictureTone tone() = 0;
    // Returns the tone that spans all that its bits hold, whatever its pixels.
    virtual PictureTone wholeTone() = 0;
    // Reads the window, averaged down by the factor `shrink` (>= 1) each way. Throws Error.
    virtual GroundPicture read(const PixelWindow& window, const glm::dvec2& shrink,
                               const PictureTone& tone) = 0;
};

// Opens a picture. `expected` completes the sentence "expected ..." and `advice` says what to give instead.
// Throws Error.
std::unique_ptr<RasterPicture> openRasterPicture(const std::filesystem::path& file,
                                                 const std::string& expected, const std::string& advice);

// Maps pixels of `target` to those of `source`. Throws Error that names `file` when there is no way between
// the two reference systems.
PixelMap mapPixels(const Georeference& target, const Georeference& source, const std::filesystem::path& file);

// Returns whether the two rasters share ground. Throws Error as mapPixels does.
bool overlap(const Georeference& a, const Georeference& b, const std::filesystem::path& file);

// Returns where the places of a world lie whose grid this is, north up, with `spacing` metres a pixel; the
// world's origin is the grid's middle. Returns null where its reference system does not say, or belongs to
// another body.
std::unique_ptr<EarthPlaces> earthPlaces(const Georeference& grid, const glm::dvec2& spacing);

// Returns the same places in the reference system of the file, `source`, that the grid was made of. Returns
// null where there is no way between the two systems.
std::unique_ptr<ReferencePlaces> referencePlaces(const Georeference& source, const Georeference& grid,
                                                 const glm::dvec2& spacing);

// Writes a GeoTIFF over the grid's samples; the file is made anew. Throws Error.
void writeGeoTiff(const std::filesystem::path& file, const Georeference& grid, const WrittenRaster& raster);

// Reads the lines, areas and places of a GPX or GeoJSON file, one or more; areas without their holes, and
// tracks without their points. Throws Error.
TrackFile readTrackFile(const std::filesystem::path& file);
// Reads the lines and areas of a file, one or more; the segments of a track are one line. Throws Error.
std::vector<TrackLine> readTracks(const std::filesystem::path& file);

// The module's functions, which those above call.
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
