// Elevation samples through GDAL, a run of rows at a time.
#include "terrain/gdal/dem_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr double kAbsurd_m = 1e7;  // more than the Earth's radius: no height of any ground
constexpr int kGsiSide = 256;
constexpr const char* kReadAgain = "fetch or export the file again";
constexpr const char* kGiveDem =
    "give a GeoTIFF, .hgt, USGS DEM, ESRI ASCII or 16-bit PNG elevation model, or use this one as the image";

// Metres in the named unit; names as GDAL's drivers write them.
std::optional<double> metresIn(std::string_view unit) {
    struct Unit {
        std::string_view name;
        double metres;
    };
    static constexpr Unit kUnits[] = {{"", 1},
                                      {"m", 1},
                                      {"metre", 1},
                                      {"meter", 1},
                                      {"metres", 1},
                                      {"meters", 1},
                                      {"ft", 0.3048},
                                      {"foot", 0.3048},
                                      {"feet", 0.3048},
                                      {"us-ft", 1200.0 / 3937},
                                      {"ftus", 1200.0 / 3937},
                                      {"us survey foot", 1200.0 / 3937},
                                      {"foot_us", 1200.0 / 3937},
                                      {"dm", 0.1},
                                      {"cm", 0.01},
                                      {"mm", 0.001},
                                      {"km", 1000}};
    std::string lower(unit);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const Unit& u : kUnits)
        if (u.name == lower) return u.metres;
    return std::nullopt;
}

// What turns a stored value into metres, and which stored values mean "missing".
struct Decoder {
    double scale = 1, offset = 0;
    std::optional<double> nodata;
    bool singlePrecision = false;

    float operator()(double stored) const {
        if (nodata && (stored == *nodata ||
                       (singlePrecision && static_cast<float>(stored) == static_cast<float>(*nodata))))
            return kMissing;
        const double height = stored * scale + offset;
        return std::abs(height) <= kAbsurd_m ? static_cast<float>(height) : kMissing;
    }
};

// Files that do not name their nodata value, but whose format has a customary one.
std::optional<double> customaryNodata(GDALDataset& dataset, GDALRasterBand& band) {
    if (std::string_view(dataset.GetDriverName()) == "AAIGrid") return -9999.0;
    if (band.GetRasterDataType() == GDT_Int16) return -32768.0;
    return std::nullopt;
}

Decoder decoderFor(GDALDataset& dataset, GDALRasterBand& band, const std::filesystem::path& file,
                   double verticalScale) {
    Decoder decoder;
    int has = 0;
    const double nodata = band.GetNoDataValue(&has);
    if (has)
        decoder.nodata = nodata;
    else
        decoder.nodata = customaryNodata(dataset, band);
    decoder.singlePrecision = band.GetRasterDataType() == GDT_Float32;
    const std::string unit = band.GetUnitType() ? band.GetUnitType() : "";
    const auto metres = metresIn(unit);
    if (!metres)
        throw Error(file.string(), "band 1",
                    "expected heights in metres or feet, got the unit \"" + unit + "\"",
                    "convert the file to metres");
    decoder.scale = band.GetScale() * *metres * verticalScale;
    decoder.offset = band.GetOffset() * *metres * verticalScale;
    return decoder;
}

void checkHoldsElevations(GDALDataset& dataset, const std::filesystem::path& file) {
    GDALRasterBand& band = *dataset.GetRasterBand(1);
    const GDALDataType type = band.GetRasterDataType();
    const std::string_view driver = dataset.GetDriverName();
    const int bands = dataset.GetRasterCount();
    const bool jpeg = driver == "JPEG", colors = bands >= 3 && type != GDT_Float32 && type != GDT_Float64;
    if (jpeg || colors || band.GetColorTable())
        throw Error(file.string(), "",
                    fmt::format("expected one band of elevations, found a picture ({}, {} band{} of {})",
                                driver, bands, bands == 1 ? "" : "s", GDALGetDataTypeName(type)),
                    kGiveDem);
    if (GDALDataTypeIsComplex(type))
        throw Error(file.string(), "band 1", "expected real numbers, got complex ones", kGiveDem);
}

bool hasOwnMask(GDALRasterBand& band) {
    return (band.GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA)) == 0;
}

[[noreturn]] void throwCutOff(const std::filesystem::path& file, int row, int rows,
                              const GdalMessages& messages) {
    throw Error(file.string(), fmt::format("row {} of {}", row + 1, rows),
                "the file is cut off or damaged" + messages.reason(file), kReadAgain);
}

// Height of one GSI pixel in metres; NaN for its nodata, (128, 0, 0).
double gsiHeight(int r, int g, int b) {
    constexpr int kWrap = 1 << 24;
    const int code = r << 16 | g << 8 | b;
    if (code == kWrap / 2) return std::numeric_limits<double>::quiet_NaN();
    return 0.01 * (code < kWrap / 2 ? code : code - kWrap);
}

std::vector<unsigned char> gsiBytes(GDALDataset& dataset) {
    std::vector<unsigned char> bytes(3u * kGsiSide * kGsiSide);
    const CPLErr failed = dataset.RasterIO(GF_Read, 0, 0, kGsiSide, kGsiSide, bytes.data(), kGsiSide,
                                           kGsiSide, GDT_Byte, 3, nullptr, 3, 3 * kGsiSide, 1, nullptr);
    if (failed != CE_None) bytes.clear();
    return bytes;
}

std::vector<float> gsiSamples(GDALDataset& dataset, double verticalScale) {
    const std::vector<unsigned char> bytes = gsiBytes(dataset);
    std::vector<float> heights(static_cast<std::size_t>(kGsiSide) * kGsiSide);
    for (std::size_t k = 0; k < heights.size(); ++k)
        heights[k] =
            static_cast<float>(gsiHeight(bytes[3 * k], bytes[3 * k + 1], bytes[3 * k + 2]) * verticalScale);
    return heights;
}

}  // namespace

bool isGsiTile(GDALDataset& dataset) {
    if (dataset.GetRasterXSize() != kGsiSide || dataset.GetRasterYSize() != kGsiSide) return false;
    const int bands = dataset.GetRasterCount();
    if (bands < 3 || bands > 4 || dataset.GetRasterBand(1)->GetRasterDataType() != GDT_Byte) return false;
    if (std::string_view(dataset.GetDriverName()) == "JPEG") return false;
    const std::vector<unsigned char> bytes = gsiBytes(dataset);
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        const double height = gsiHeight(bytes[k], bytes[k + 1], bytes[k + 2]);
        if (height < -500 || height > 9000) return false;
    }
    return !bytes.empty();
}

std::vector<float> readSamples(GDALDataset& dataset, GdalMessages& messages,
                               const std::filesystem::path& file, double verticalScale, Progress& progress) {
    if (isGsiTile(dataset)) return gsiSamples(dataset, verticalScale);
    checkHoldsElevations(dataset, file);
    GDALRasterBand& band = *dataset.GetRasterBand(1);
    const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize();
    const Decoder decode = decoderFor(dataset, band, file, verticalScale);
    int blockWidth = 0, blockHeight = 0;
    band.GetBlockSize(&blockWidth, &blockHeight);
    const int run = std::clamp(blockHeight, 16, 256);
    const bool masked = hasOwnMask(band);
    messages.clear();  // a georeference that GDAL could not make sense of is no damage to the samples
    std::vector<double> stored(static_cast<std::size_t>(width) * run);
    std::vector<unsigned char> mask(masked ? stored.size() : 0);
    std::vector<float> heights(static_cast<std::size_t>(width) * height);
    for (int row = 0; row < height; row += run) {
        progress.report(double(row) / height, "reading " + file.filename().string());
        const int rows = std::min(run, height - row);
        CPLErr failed = band.RasterIO(GF_Read, 0, row, width, rows, stored.data(), width, rows, GDT_Float64,
                                      0, 0, nullptr);
        if (masked && failed == CE_None)
            failed = band.GetMaskBand()->RasterIO(GF_Read, 0, row, width, rows, mask.data(), width, rows,
                                                  GDT_Byte, 0, 0, nullptr);
        if (failed != CE_None || messages.hasError()) throwCutOff(file, row, height, messages);
        float* out = &heights[static_cast<std::size_t>(row) * width];
        for (std::size_t k = 0; k < static_cast<std::size_t>(width) * rows; ++k)
            out[k] = masked && mask[k] == 0 ? kMissing : decode(stored[k]);
    }
    return heights;
}

}  // namespace stereonav
