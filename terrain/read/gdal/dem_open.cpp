#include "terrain/read/gdal/dem_open.h"

#include <fmt/format.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "terrain/raster/elevation_folder.h"
#include "terrain/read/gdal/folder_mix.h"
#include "terrain/read/gdal/height_band.h"
#include "terrain/read/gdal/height_convert.h"
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

// Doubles where floats do not hold what some file has stored.
bool needsDoubles(GDALDataType type) {
    return type != GDT_Byte && type != GDT_UInt16 && type != GDT_Int16 && type != GDT_Float32;
}

// The file's band in floats, which says what stands for missing samples also where the file leaves it to
// custom: what mixes files looks at what they say alone. In memory, a few hundred bytes, until the program
// ends.
std::string wrapped(const std::filesystem::path& file, GDALDataset& dataset, const HeightBand& band,
                    const char* type) {
    static std::atomic<int> count = 0;
    const std::string name = fmt::format("/vsimem/stereonav_part_{}.vrt", count++);
    ProgramWords words;
    words.add("-of").add("VRT").add("-b").add(std::to_string(band.number)).add("-ot").add(type);
    if (band.nodata) words.add("-a_nodata").add(fmt::format("{:.17g}", *band.nodata));
    GDALTranslateOptions* const options = GDALTranslateOptionsNew(words.get(), nullptr);
    const GdalDataset made(GDALDataset::FromHandle(
        GDALTranslate(name.c_str(), GDALDataset::ToHandle(&dataset), options, nullptr)));
    GDALTranslateOptionsFree(options);
    if (!made)
        throwMisfit(file, "", "can not be laid beside others",
                    "bring it to GeoTIFF, for example with gdal_translate");
    return name;
}

// Once files are mixed nothing tells a -9999 that stands for a missing sample from a height, so it is said
// before.
bool customaryIsMissing(const std::vector<std::filesystem::path>& files, const std::vector<HeightBand>& bands,
                        const std::vector<FilePlan>& plans, const GdalMessages& messages) {
    const bool unnamed =
        std::any_of(bands.begin(), bands.end(), [](const HeightBand& band) { return !band.nodata; });
    if (!unnamed || !filesAreMixed(plans)) return false;
    for (std::size_t n = 0; n < files.size(); ++n) {
        const GdalDataset dataset = openRaster(files[n], messages, kExpected, kAdvice);
        if (hasDeepGround(*dataset, bands[n])) return false;
    }
    return true;
}

GdalDataset openFolder(const std::filesystem::path& folder, const GdalMessages& messages) {
    const std::vector<std::filesystem::path> files = elevationFilesIn(folder);
    if (files.empty())
        throwMisfit(folder, "", "expected elevation files, found a folder without any", kAdvice);
    Common common;
    bool doubles = false;
    std::vector<HeightBand> bands;
    std::vector<FilePlan> plans;
    for (const std::filesystem::path& file : files) {
        const GdalDataset dataset = openRaster(file, messages, kExpected, kAdvice);
        checkStandsNorthUp(*dataset, file);
        if (common.file.empty()) {
            common = {file, systemOf(*dataset), heightBandOf(*dataset, file)};
            if (common.band.scale != 1 || common.band.offset != 0 || common.band.masked ||
                common.band.signedBytes)
                throwMisfit(file, "heights",
                            "have a scale, a unit or a mask, which a folder of files can not",
                            "make them metres, for example with gdal_translate -unscale");
        } else {
            checkFits(*dataset, file, common);
        }
        bands.push_back(heightBandOf(*dataset, file));
        plans.emplace_back(*dataset);
        doubles |= needsDoubles(dataset->GetRasterBand(common.band.number)->GetRasterDataType());
    }
    const bool customary = customaryIsMissing(files, bands, plans, messages);
    ProgramWords names;
    for (std::size_t n = 0; n < files.size(); ++n) {
        const std::filesystem::path whole = std::filesystem::absolute(files[n]);
        const GdalDataset dataset = openRaster(whole, messages, kExpected, kAdvice);
        if (customary && !bands[n].nodata) bands[n].nodata = kCustomaryMissing;
        names.add(wrapped(whole, *dataset, bands[n], doubles ? "Float64" : "Float32"));
    }
    ProgramWords words;
    words.add("-strict").add("-resolution").add("highest").add("-r").add("bilinear");
    words.add("-vrtnodata").add("nan");
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

bool isTextGrid(GDALDataset& dataset) {
    const std::string_view driver = dataset.GetDriverName();
    return driver == "AAIGrid" || driver == "GRASSASCIIGrid" || driver == "GSAG";
}

GdalDataset thinnedDem(GDALDataset& whole, long long most, const std::filesystem::path& place) {
    const int width = whole.GetRasterXSize(), height = whole.GetRasterYSize();
    const double share = std::sqrt(double(most) / (double(width) * height));
    if (share >= 1 || isTextGrid(whole)) return nullptr;
    const auto thinned = [share](int size) {
        return std::to_string(std::max(static_cast<int>(size * share), 2));
    };
    ProgramWords words;
    words.add("-of").add("VRT").add("-r").add("nearest").add("-outsize");
    words.add(thinned(width)).add(thinned(height));
    GDALTranslateOptions* const options = GDALTranslateOptionsNew(words.get(), nullptr);
    GdalDataset made(
        GDALDataset::FromHandle(GDALTranslate("", GDALDataset::ToHandle(&whole), options, nullptr)));
    GDALTranslateOptionsFree(options);
    if (!made) throwMisfit(place, "", "can not be read in coarser steps", kAdvice);
    return made;
}

GdalDataset openDem(const std::filesystem::path& place, const GdalMessages& messages) {
    std::error_code failed;
    return std::filesystem::is_directory(place, failed) ? openFolder(place, messages)
                                                        : openRaster(place, messages, kExpected, kAdvice);
}

}  // namespace stereonav
