#include "terrain/read/gdal/dem_open.h"

#include <fmt/format.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "terrain/raster/elevation_folder.h"
#include "terrain/read/gdal/height_band.h"
#include "terrain/read/gdal/program_words.h"
#include "terrain/read/gdal/vrt_check.h"

namespace stereonav {
namespace {

constexpr const char* kExpected = "an elevation model";
constexpr const char* kAdvice = "give a GeoTIFF, .hgt, USGS DEM, ESRI ASCII or 16-bit PNG file";

[[noreturn]] void throwMisfit(const std::filesystem::path& file, const std::string& what,
                              const std::string& problem, const std::string& advice) {
    throw Error(file.string(), what, problem, advice);
}

// What all files of a folder must have in common.
struct Common {
    std::filesystem::path file;  // the first
    std::unique_ptr<OGRSpatialReference> system;
    HeightBand band;
    GDALDataType type = GDT_Unknown;
};

std::unique_ptr<OGRSpatialReference> systemOf(GDALDataset& dataset) {
    const OGRSpatialReference* const system = dataset.GetSpatialRef();
    return system ? std::unique_ptr<OGRSpatialReference>(system->Clone()) : nullptr;
}

void checkStandsNorthUp(GDALDataset& dataset, const std::filesystem::path& file) {
    double t[6];
    const bool placed = dataset.GetGeoTransform(t) == CE_None;
    if (placed && t[2] == 0 && t[4] == 0 && t[1] > 0 && t[5] < 0) return;
    throwMisfit(
        file, "georeference", placed ? "is turned or mirrored" : "does not say where it lies",
        "files of a folder stand north up: bring it there with gdalwarp, or take it out of the folder");
}

void checkFits(GDALDataset& dataset, const std::filesystem::path& file, const Common& common) {
    const auto system = systemOf(dataset);
    const bool same = !system == !common.system && (!system || system->IsSame(common.system.get()));
    const std::string first = common.file.filename().string();
    if (!same)
        throwMisfit(file, "reference system", "is not that of " + first,
                    "bring all files of the folder to one, for example with gdalwarp -t_srs");
    const HeightBand band = heightBandOf(dataset, file);
    if (band.number != common.band.number || band.scale != common.band.scale ||
        band.offset != common.band.offset || band.unit != common.band.unit ||
        band.masked != common.band.masked || band.signedBytes != common.band.signedBytes)
        throwMisfit(file, "heights",
                    "are not meant as those of " + first + ": band, unit, scale or mask differ",
                    "make them alike, for example with gdal_translate -unscale");
}

// What stands for missing samples of all, where no file is too.
std::string missingValueOf(const std::filesystem::path& folder, const std::optional<double>& named,
                           GDALDataType type) {
    if (type == GDT_Float32 || type == GDT_Float64) return "nan";
    if (named) return fmt::format("{:.17g}", *named);
    if (type == GDT_Int16 || type == GDT_Int32) return "-32768";
    throwMisfit(folder, "missing samples", "no file names a value for them",
                "name one, for example with gdal_edit.py -a_nodata");
}

GdalDataset openFolder(const std::filesystem::path& folder, const GdalMessages& messages) {
    const std::vector<std::filesystem::path> files = elevationFilesIn(folder);
    if (files.empty())
        throwMisfit(folder, "", "expected elevation files, found a folder without any", kAdvice);
    Common common;
    std::optional<double> missing;
    for (const std::filesystem::path& file : files) {
        const GdalDataset dataset = openRaster(file, messages, kExpected, kAdvice);
        checkStandsNorthUp(*dataset, file);
        if (common.file.empty()) {
            common = {file, systemOf(*dataset), heightBandOf(*dataset, file), GDT_Unknown};
            common.type = dataset->GetRasterBand(common.band.number)->GetRasterDataType();
            if (common.band.scale != 1 || common.band.offset != 0 || common.band.masked)
                throwMisfit(file, "heights",
                            "have a scale, a unit or a mask, which a folder of files can not",
                            "make them metres, for example with gdal_translate -unscale");
        } else {
            checkFits(*dataset, file, common);
        }
        const HeightBand band = heightBandOf(*dataset, file);
        if (!missing && band.nodata) missing = band.nodata;
    }
    ProgramWords words;
    words.add("-strict").add("-resolution").add("highest").add("-r").add("bilinear");
    words.add("-b").add(std::to_string(common.band.number));
    words.add("-vrtnodata").add(missingValueOf(folder, missing, common.type));
    ProgramWords names;
    for (const std::filesystem::path& file : files) names.add(file.string());
    GDALBuildVRTOptions* const options = GDALBuildVRTOptionsNew(words.get(), nullptr);
    GdalDataset made(GDALDataset::FromHandle(
        GDALBuildVRT("", static_cast<int>(files.size()), nullptr, names.get(), options, nullptr)));
    GDALBuildVRTOptionsFree(options);
    if (made) return made;
    throwMisfit(folder, "", "its files do not make one ground" + messages.reason(folder),
                "join them with gdalwarp, and name what that gives");
}

bool isWhole(GDALDataset& dataset, const GdalMessages& messages) {
    constexpr int kRows = 64;
    const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize();
    std::vector<float> rows(static_cast<std::size_t>(width) * kRows);
    for (int row = 0; row < height; row += kRows) {
        const int count = std::min(kRows, height - row);
        const CPLErr failed = dataset.GetRasterBand(1)->RasterIO(GF_Read, 0, row, width, count, rows.data(),
                                                                 width, count, GDT_Float32, 0, 0, nullptr);
        if (failed != CE_None || messages.hasError()) return false;
    }
    return true;
}

}  // namespace

std::filesystem::path damagedFileIn(const std::filesystem::path& folder) {
    for (const std::filesystem::path& file : elevationFilesIn(folder)) {
        const GdalMessages messages;
        const GdalDataset dataset(GDALDataset::Open(file.string().c_str(), GDAL_OF_RASTER, rasterDrivers()));
        if (!dataset || !isWhole(*dataset, messages)) return file;
    }
    return {};
}

GdalDataset openDem(const std::filesystem::path& place, const GdalMessages& messages) {
    std::error_code failed;
    return std::filesystem::is_directory(place, failed) ? openFolder(place, messages)
                                                        : openRaster(place, messages, kExpected, kAdvice);
}

}  // namespace stereonav
