// GDAL's drivers, messages and handles; see the header.
#include "terrain/gdal/gdal_session.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <mutex>
#include <string_view>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr long long kMaxSide = 65536;
constexpr long long kMaxSamples = 1ll << 28;  // 1 GiB of heights; as much again for the pyramid and colour

void registerDriversOnce() {
    static std::once_flag once;
    std::call_once(once, [] { GDALAllRegister(); });
}

void checkFile(const std::filesystem::path& file, const std::string& advice) {
    std::error_code code;
    const auto status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status))
        throw Error(file.string(), "", "there is no such file", "check the name and the folder");
    if (std::filesystem::is_directory(status))
        throw Error(file.string(), "", "expected a file, found a folder", "name the file itself");
    const auto size = std::filesystem::file_size(file, code);
    if (!code && size == 0) throw Error(file.string(), "", "the file is empty", advice);
}

}  // namespace

GdalMessages::GdalMessages() {
    registerDriversOnce();
    // Else the rest of a picture that is cut off is filled with gray.
    CPLSetThreadLocalConfigOption("GDAL_ERROR_ON_LIBJPEG_WARNING", "YES");
    CPLPushErrorHandlerEx(&GdalMessages::keep, this);
}

GdalMessages::~GdalMessages() {
    CPLPopErrorHandler();
}

void GdalMessages::keep(CPLErr level, CPLErrorNum, const char* text) {
    auto* self = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    constexpr std::size_t kLongest = 400;
    if (level >= CE_Failure && self->mFirstError.empty())
        self->mFirstError = std::string(text).substr(0, kLongest);
}

std::string GdalMessages::reason(const std::filesystem::path& file) const {
    std::string text = mFirstError;
    const std::string name = file.string();
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name)) {
        std::size_t length = name.size();
        while (at + length < text.size() &&
               std::string_view(":, ").find(text[at + length]) != std::string_view::npos)
            ++length;
        text.erase(at, length);
    }
    return text.empty() ? text : " (" + text + ")";
}

GdalDataset openRaster(const std::filesystem::path& file, const GdalMessages& messages,
                       const std::string& expected, const std::string& advice) {
    checkFile(file, advice);
    // A fixed list: formats that fetch other files or addresses are none of ours.
    static const char* const kDrivers[] = {"GTiff", "SRTMHGT", "USGSDEM", "AAIGrid", "DTED",
                                           "EHdr",  "HFA",     "WEBP",    "GIF",     "JP2OpenJPEG",
                                           "PNG",   "JPEG",    "BMP",     nullptr};
    GdalDataset dataset(GDALDataset::Open(
        file.string().c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, kDrivers));
    if (dataset && dataset->GetRasterCount() > 0) return dataset;
    std::string reason = messages.reason(file);
    if (reason.find("not recognized") != std::string::npos) reason.clear();
    throw Error(file.string(), "", "expected " + expected + ", found something else" + reason, advice);
}

Georeference georeferenceOf(GDALDataset& dataset, bool& known) {
    Georeference place;
    place.width = dataset.GetRasterXSize();
    place.height = dataset.GetRasterYSize();
    std::array<double, 6> transform{};
    known = dataset.GetGeoTransform(transform.data()) == CE_None;
    if (known) place.transform = transform;
    if (const OGRSpatialReference* system = dataset.GetSpatialRef(); known && system)
        place.wkt = wktOf(*system);
    return place;
}

std::string wktOf(const OGRSpatialReference& system) {
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    char* text = nullptr;
    system.exportToWkt(&text, options);
    const std::string wkt = text ? text : "";
    CPLFree(text);
    return wkt;
}

void checkRasterSize(const std::filesystem::path& file, long long width, long long height) {
    if (width >= 1 && height >= 1 && width <= kMaxSide && height <= kMaxSide && width * height <= kMaxSamples)
        return;
    throw Error(file.string(), "size",
                fmt::format("expected at most {0} samples a side and {1} in all, got {2} x {3}", kMaxSide,
                            kMaxSamples, width, height),
                "cut out a part or thin it out, for example with gdal_translate -outsize");
}

}  // namespace stereonav
