// Everything that needs GDAL, handed on to its module.
#include "terrain/read/raster_file.h"

#include "engine/base/error.h"
#include "engine/base/module.h"

namespace stereonav {
namespace {

const RasterFunctions& gdal() {
    static const auto& functions =
        moduleFunctions<RasterFunctions>("gdal", "to read elevation models and pictures of the ground");
    return functions;
}

}  // namespace

DemGrid readDem(const std::filesystem::path& file, double verticalScale, Progress& progress,
                const BytesForSamples& after) {
    return gdal().readDem(file, verticalScale, progress, after);
}

DemGlance glanceAtDem(const std::filesystem::path& file) {
    return gdal().glanceAtDem(file);
}

std::unique_ptr<DemRows::Reader> openDemRows(const std::filesystem::path& file, long long most) {
    return gdal().openDemRows(file, most);
}

DemRows::DemRows(const std::filesystem::path& file) : mReader(openDemRows(file, 0)) {}
DemRows::DemRows(const std::filesystem::path& file, long long most) : mReader(openDemRows(file, most)) {}

std::unique_ptr<RasterPicture> openRasterPicture(const std::filesystem::path& file,
                                                 const std::string& expected, const std::string& advice) {
    return gdal().openRasterPicture(file, expected, advice);
}

PixelMap mapPixels(const Georeference& target, const Georeference& source,
                   const std::filesystem::path& file) {
    return gdal().mapPixels(target, source, file);
}

bool overlap(const Georeference& a, const Georeference& b, const std::filesystem::path& file) {
    return gdal().overlap(a, b, file);
}

std::unique_ptr<EarthPlaces> earthPlaces(const Georeference& grid, const glm::dvec2& spacing) {
    return gdal().earthPlaces(grid, spacing);
}

std::unique_ptr<ReferencePlaces> referencePlaces(const Georeference& source, const Georeference& grid,
                                                 const glm::dvec2& spacing) {
    return gdal().referencePlaces(source, grid, spacing);
}

void writeGeoTiff(const std::filesystem::path& file, const Georeference& grid, const WrittenRaster& raster) {
    gdal().writeGeoTiff(file, grid, raster);
}

TrackFile readTrackFile(const std::filesystem::path& file) {
    return gdal().readTrackFile(file);
}

std::vector<TrackLine> readTracks(const std::filesystem::path& file) {
    TrackFile read = readTrackFile(file);
    if (read.lines.empty())
        throw Error(file.string(), "", "expected a track, a line or an area, found none",
                    "single places have no length");
    return joinedSegments(std::move(read.lines));
}

}  // namespace stereonav
