// GDAL's drivers, messages and handles; see the header.
#include "terrain/read/gdal/gdal_session.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_frmts.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cctype>
#include <mutex>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "terrain/raster/elevation_folder.h"
#include "terrain/read/gdal/control_points.h"
#include "terrain/read/gdal/guarded_drivers.h"
#include "terrain/read/gdal/local_files.h"
#include "terrain/read/gdal/netcdf_size.h"
#include "terrain/read/gdal/raster_words.h"
#include "terrain/read/gdal/vrt_check.h"

namespace stereonav {
namespace {

// Bounds GDAL's blocks, which else take a twentieth of the machine's memory. The heap keeps some of that
// after a file is closed.
void boundBlocks() {
    constexpr double kShare = 0.25, kLeast = 4 << 20;
    const bool wished = CPLGetConfigOption("GDAL_CACHEMAX", nullptr) != nullptr;
    const auto most = static_cast<double>(wished ? GDALGetCacheMax64() : kGdalBlocks);
    GDALSetCacheMax64(static_cast<GIntBig>(std::min(most, std::max(kLeast, kShare * availableMemory()))));
}

// Only formats that hold their data themselves: none that fetches another file or address is there even for
// what a virtual raster names. MBTiles are read through SQLite.
void registerDriversOnce() {
    static std::once_flag once;
    std::call_once(once, [] {
        for (void (*const add)() : {GDALRegister_GTiff,
                                    GDALRegister_SRTMHGT,
                                    GDALRegister_USGSDEM,
                                    GDALRegister_AAIGrid,
                                    GDALRegister_GRASSASCIIGrid,
                                    GDALRegister_DTED,
                                    GDALRegister_EHdr,
                                    GDALRegister_HFA,
                                    GDALRegister_ENVI,
                                    GDALRegister_SAGA,
                                    GDALRegister_GSAG,
                                    GDALRegister_GSBG,
                                    GDALRegister_GS7BG,
                                    GDALRegister_BT,

                                    GDALRegister_WEBP,
                                    GDALRegister_GIF,
                                    GDALRegister_JP2OpenJPEG,
                                    GDALRegister_PNG,
                                    GDALRegister_JPEG,
                                    GDALRegister_BMP,
                                    RegisterOGRGeoPackage,
                                    RegisterOGRSQLite,
                                    GDALRegister_MBTiles,
                                    GDALRegister_netCDF,
                                    GDALRegister_VRT})
            add();
        guardDrivers(rasterDrivers());
        constexpr const char* kDatabases[] = {"SQLite", nullptr};
        guardDrivers(kDatabases);
        keepGdalToLocalFiles();
        boundBlocks();
    });
}

// The one of the rasters in a file (names and descriptions by turns) that is called heights; "" where none
// is, or several are.
std::string heightsAmong(char** several) {
    std::string found;
    for (int n = 1; n <= CSLCount(several) / 2; ++n) {
        const auto text = [&](const char* what) {
            const char* const value =
                CSLFetchNameValue(several, fmt::format("SUBDATASET_{}_{}", n, what).c_str());
            return std::string(value ? value : "");
        };
        const std::string name = text("NAME");
        if (!speaksOfHeights(name.substr(name.rfind(':') + 1)) && !speaksOfHeights(text("DESC"))) continue;
        if (!found.empty()) return "";
        found = name;
    }
    return found;
}

GdalDataset opened(const std::string& name) {
    return GdalDataset(GDALDataset::Open(
        name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, rasterDrivers()));
}

}  // namespace

void checkFileForGdal(const std::filesystem::path& file, const std::string& advice) {
    if (namesNetwork(file))
        throw Error(file.string(), "", "expected a file on this machine, found an address",
                    "fetch it first and name the copy");
    std::error_code code;
    const auto status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status))
        throw Error(file.string(), "", "there is no such file", "check the name and the folder");
    if (std::filesystem::is_directory(status))
        throw Error(file.string(), "", "expected a file, found a folder", "name the file itself");
    if (!std::filesystem::is_regular_file(status))
        throw Error(file.string(), "", "expected a file, found a pipe or a device",
                    "copy what it gives into a file");
    const auto size = std::filesystem::file_size(file, code);
    if (!code && size == 0) throw Error(file.string(), "", "the file is empty", advice);
}

GdalMessages::GdalMessages() {
    CPLPushErrorHandlerEx(&GdalMessages::keep, this);
    registerDriversOnce();
    // Else the rest of a picture that is cut off is filled with gray.
    CPLSetThreadLocalConfigOption("GDAL_ERROR_ON_LIBJPEG_WARNING", "YES");
    // Else the vertical reference system of GeoTIFF 1.0 is left out.
    CPLSetThreadLocalConfigOption("GTIFF_REPORT_COMPD_CS", "YES");
    CPLSetThreadLocalConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
    // Nothing is written beside what is read.
    CPLSetThreadLocalConfigOption("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");
}

GdalMessages::~GdalMessages() {
    CPLPopErrorHandler();
}

void GdalMessages::keep(CPLErr level, CPLErrorNum number, const char* text) {
    auto* self = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (number == kRefused && self->mRefused.empty()) self->mRefused = text;
    constexpr std::size_t kLongest = 400;
    if (level >= CE_Failure && self->mFirstError.empty())
        self->mFirstError = std::string(text).substr(0, kLongest);
}

std::string GdalMessages::reason(const std::filesystem::path& file) const {
    std::string text = mFirstError;
    for (const std::string& name : {nameForGdal(file), file.string()})
        for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name)) {
            std::size_t length = name.size();
            while (at + length < text.size() &&
                   std::string_view(":, ").find(text[at + length]) != std::string_view::npos)
                ++length;
            text.erase(at, length);
        }
    return text.empty() ? text : " (" + text + ")";
}

void GdalMessages::throwIfRefused(const std::filesystem::path& file) const {
    if (mRefused.empty()) return;
    const std::string name = nameForGdal(file);
    if (!mRefused.starts_with(name)) throw Error(file.string(), "", mRefused, "");
    throw Error("", "", file.string() + mRefused.substr(name.size()), "");
}

std::string nameForGdal(const std::filesystem::path& file) {
    std::error_code code;
    const std::filesystem::path whole = std::filesystem::absolute(file, code);
    return (code ? file : whole).string();
}

GdalDataset openRaster(const std::filesystem::path& file, const GdalMessages& messages,
                       const std::string& expected, const std::string& advice,
                       std::vector<std::string>* notes) {
    checkFileForGdal(file, advice);
    const std::string note = outsideNote(file, filesOfVirtualRaster(file));
    if (notes && !note.empty()) notes->push_back(note);
    std::error_code failed;
    if (const auto bytes = classicNetCdfSize(file);
        bytes && *bytes > std::filesystem::file_size(file, failed))
        throw Error(file.string(), "", "the file is cut off or damaged", "fetch or export the file again");
    // The driver unpacks zip itself, and no other archive.
    const bool gzipped = isPackedHeights(file) && std::tolower(file.native().back()) == 'z';
    GdalDataset dataset = opened((gzipped ? "/vsigzip/" : "") + nameForGdal(file));
    if (dataset && dataset->GetRasterCount() > 0) return dataset;
    char** const several = dataset ? dataset->GetMetadata("SUBDATASETS") : nullptr;
    if (dataset && std::string_view(dataset->GetDriverName()) == "netCDF")
        if (const std::string heights = heightsAmong(several); !heights.empty())
            if (GdalDataset found = opened(heights); found && found->GetRasterCount() > 0) return found;
    if (CSLCount(several) > 2)  // a name and a description each
        throw Error(file.string(), "", "expected " + expected + ", found several rasters in one file",
                    "take one of them out, for example with gdal_translate, and name that");
    if (!dataset) messages.throwIfRefused(file);
    std::string reason = messages.reason(file);
    if (reason.find("not recognized") != std::string::npos) reason.clear();
    throw Error(file.string(), "", "expected " + expected + ", found something else" + reason, advice);
}

Georeference georeferenceOf(GDALDataset& dataset, const std::filesystem::path& file, bool& known) {
    Georeference place;
    place.width = dataset.GetRasterXSize();
    place.height = dataset.GetRasterYSize();
    std::array<double, 6> transform{};
    known = dataset.GetGeoTransform(transform.data()) == CE_None;
    if (known) {
        place.transform = transform;
        if (const OGRSpatialReference* system = dataset.GetSpatialRef()) place.wkt = planWkt(*system);
    } else if (dataset.GetGCPCount() > 0) {
        placeByControlPoints(dataset, file, place);
        known = true;
    }
    return place;
}

std::string wktOf(const OGRSpatialReference& system) {
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    char* text = nullptr;
    system.exportToWkt(&text, options);
    std::string wkt = text ? text : "";
    CPLFree(text);
    return wkt;
}

std::string planWkt(const OGRSpatialReference& system) {
    OGRSpatialReference plan(system);
    plan.StripVertical();
    return wktOf(plan);
}

void checkRasterSize(const std::filesystem::path& file, long long width, long long height,
                     const RasterLimits& limits) {
    if (width >= 1 && height >= 1 && width <= limits.side && height <= limits.side &&
        width * height <= limits.samples)
        return;
    throw Error(file.string(), "size",
                fmt::format("expected at most {} samples a side and {} in all, got {} x {}", limits.side,
                            limits.samples, width, height),
                "cut out a part or thin it out, for example with gdal_translate -outsize");
}

}  // namespace stereonav
