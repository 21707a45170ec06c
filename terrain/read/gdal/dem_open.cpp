#include "terrain/read/gdal/dem_open.h"

#include <fmt/format.h>
#include <gdal_utils.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "terrain/raster/elevation_folder.h"
#include "terrain/read/gdal/folder_choice.h"
#include "terrain/read/gdal/height_convert.h"
#include "terrain/read/gdal/program_words.h"
#include "terrain/read/gdal/reference_system.h"
#include "terrain/read/gdal/vrt_check.h"

namespace stereonav {
namespace {

constexpr const char* kExpected = "an elevation model";
constexpr const char* kAdvice = "give a GeoTIFF, .hgt, USGS DEM, ESRI ASCII or 16-bit PNG file";

[[noreturn]] void throwMisfit(const std::filesystem::path& file, const std::string& what,
                              const std::string& problem, const std::string& advice) {
    throw Error(file.string(), what, problem, advice);
}

void checkStandsNorthUp(const FolderFile& file) {
    if (file.northUp) return;
    throwMisfit(file.file, "georeference",
                file.placed ? "is turned or mirrored" : "does not say where it lies",
                "files of a folder have to be north up: turn it with gdalwarp, or take it out of the folder");
}

void checkFits(const FolderFile& file, const FolderFile& common) {
    const bool same =
        !file.system == !common.system && (!file.system || file.system->IsSame(common.system.get()));
    const std::string first = common.file.filename().string();
    if (!same)
        throwMisfit(file.file, "reference system", "is not that of " + first,
                    "reproject all files of the folder to one, for example with gdalwarp -t_srs");
    const HeightBand &band = file.band, &other = common.band;
    if (band.number != other.number || band.scale != other.scale || band.offset != other.offset ||
        band.unit != other.unit || band.masked != other.masked || band.signedBytes != other.signedBytes)
        throwMisfit(file.file, "heights",
                    "have another meaning than those of " + first + ": band, unit, scale or mask differ",
                    "make them alike, for example with gdal_translate -unscale");
}

void checkCanBeMixed(const FolderFile& file) {
    if (!file.band.masked && !file.band.signedBytes) return;
    throwMisfit(file.file, "heights", "have a mask or signed bytes, which files of a folder may not have",
                "convert them to metres, for example with gdal_translate -unscale");
}

// Returns whether floats can not hold the numbers that a file stores in this type.
bool needsDoubles(GDALDataType type) {
    return type != GDT_Byte && type != GDT_UInt16 && type != GDT_Int16 && type != GDT_Float32;
}

// Makes a virtual raster of the file's band in floats, with a nodata value even where the file leaves that to
// custom: combining files considers only nodata values that are named. It is in memory, takes a few hundred
// bytes, and stays until the program ends.
std::string wrapped(const FolderFile& file, GDALDataset& dataset, const char* type) {
    static std::atomic<int> count = 0;
    std::string name = fmt::format("{}{}.vrt", kOwnVirtualRasters, count++);
    ProgramWords words;
    words.add("-of").add("VRT").add("-b").add(std::to_string(file.band.number)).add("-ot").add(type);
    if (file.band.nodata) words.add("-a_nodata").add(fmt::format("{:.17g}", *file.band.nodata));
    GDALTranslateOptions* const options = GDALTranslateOptionsNew(words.get(), nullptr);
    const GdalDataset made(GDALDataset::FromHandle(
        GDALTranslate(name.c_str(), GDALDataset::ToHandle(&dataset), options, nullptr)));
    GDALTranslateOptionsFree(options);
    if (!made)
        throwMisfit(file.file, "", "can not be joined with other files",
                    "convert it to GeoTIFF, for example with gdal_translate");
    double t[6];
    if (file.plan.turned != 0 && made->GetGeoTransform(t) == CE_None) {
        t[0] += file.plan.turned;
        made->SetGeoTransform(t);
    }
    return name;
}

// Returns whether an unnamed -9999 stands for missing samples. Decided before files are mixed, since
// afterwards it can not be told from a height.
bool customaryIsMissing(const std::vector<FolderFile>& files, const GdalMessages& messages) {
    const bool unnamed =
        std::any_of(files.begin(), files.end(), [](const FolderFile& file) { return !file.band.nodata; });
    std::vector<FilePlan> plans;
    plans.reserve(files.size());
    for (const FolderFile& file : files) plans.push_back(file.plan);
    if (!unnamed || !filesAreMixed(plans)) return false;
    for (const FolderFile& file : files) {
        const GdalDataset dataset = openRaster(file.file, messages, kExpected, kAdvice);
        if (hasDeepGround(*dataset, file.band)) return false;
    }
    return true;
}

// Returns whether places look like degrees, by the rule of dem_placement.cpp, for files that name no system.
bool lookLikeDegrees(const std::vector<FilePlan*>& plans) {
    return std::all_of(plans.begin(), plans.end(), [](const FilePlan* plan) {
        return std::max(std::abs(plan->west), std::abs(plan->east)) <= 360 &&
               std::max(std::abs(plan->north), std::abs(plan->south)) <= 90.01 &&
               std::max(plan->width, plan->height) <= 0.02;
    });
}

// Returns the files of one ground: checked to fit together, and moved to one side of 180 degrees.
FolderChoice filesOfOneGround(const std::filesystem::path& folder, const GdalMessages& messages) {
    const std::vector<std::filesystem::path> all = elevationFilesIn(folder);
    if (all.empty()) throwMisfit(folder, "", "expected elevation files, found a folder without any", kAdvice);
    FolderChoice choice = chooseHeights(all, messages);
    std::vector<FilePlan*> plans;
    for (FolderFile& file : choice.files) {
        checkStandsNorthUp(file);
        checkFits(file, choice.files.front());
        plans.push_back(&file.plan);
    }
    checkCanBeMixed(choice.files.front());
    const auto& system = choice.files.front().system;
    turnTogether(plans, system ? fullTurnOf(*system) : lookLikeDegrees(plans) ? 360 : 0);
    return choice;
}

// Copies scale, offset, unit and names of the files' bands to the mixed dataset, since a virtual raster
// leaves them out.
void meanAsTheFiles(GDALDataset& made, const FolderFile& file, const GdalMessages& messages) {
    const GdalDataset dataset = openRaster(file.file, messages, kExpected, kAdvice);
    GDALRasterBand& from = *dataset->GetRasterBand(file.band.number);
    GDALRasterBand& to = *made.GetRasterBand(1);
    if (from.GetScale() != 1) to.SetScale(from.GetScale());
    if (from.GetOffset() != 0) to.SetOffset(from.GetOffset());
    if (const char* const unit = from.GetUnitType(); unit && *unit) to.SetUnitType(unit);
    for (const char* const key : {"positive", "standard_name"})
        if (const char* const text = from.GetMetadataItem(key)) to.SetMetadataItem(key, text);
}

OpenedDem openFolder(const std::filesystem::path& folder, const GdalMessages& messages) {
    FolderChoice choice = filesOfOneGround(folder, messages);
    std::vector<FolderFile>& files = choice.files;
    const bool doubles = std::any_of(files.begin(), files.end(),
                                     [](const FolderFile& file) { return needsDoubles(file.type); });
    const bool customary = customaryIsMissing(files, messages);
    ProgramWords names;
    OpenedDem opened;
    for (FolderFile& file : files) {
        opened.files.push_back(file.file);
        const std::filesystem::path whole = std::filesystem::absolute(file.file);
        const GdalDataset dataset = openRaster(whole, messages, kExpected, kAdvice, &opened.notes);
        if (customary && !file.band.nodata) file.band.nodata = kCustomaryMissing;
        names.add(wrapped(file, *dataset, doubles ? "Float64" : "Float32"));
    }
    ProgramWords words;
    words.add("-strict").add("-resolution").add("highest").add("-r").add("bilinear");
    words.add("-vrtnodata").add("nan");
    GDALBuildVRTOptions* const options = GDALBuildVRTOptionsNew(words.get(), nullptr);
    opened.dataset.reset(GDALDataset::FromHandle(
        GDALBuildVRT("", static_cast<int>(files.size()), nullptr, names.get(), options, nullptr)));
    GDALBuildVRTOptionsFree(options);
    if (!opened.dataset)
        throwMisfit(folder, "", "its files do not make one ground" + messages.reason(folder),
                    "join them with gdalwarp, and name what that gives");
    meanAsTheFiles(*opened.dataset, files.front(), messages);
    opened.notes.insert(opened.notes.begin(), choice.notes.begin(), choice.notes.end());
    return opened;
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
        const GdalDataset dataset(
            GDALDataset::Open(nameForGdal(file).c_str(), GDAL_OF_RASTER, rasterDrivers()));
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

OpenedDem openDem(const std::filesystem::path& place, const GdalMessages& messages) {
    std::error_code failed;
    if (std::filesystem::is_directory(place, failed)) return openFolder(place, messages);
    OpenedDem opened;
    opened.dataset = openRaster(place, messages, kExpected, kAdvice, &opened.notes);
    return opened;
}

}  // namespace stereonav
