// Elevation samples through GDAL, a run of rows at a time.
#include "terrain/read/gdal/dem_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "engine/base/error.h"
#include "terrain/read/gdal/height_band.h"
#include "terrain/read/height_limits.h"

namespace stereonav {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr int kGsiSide = 256;
constexpr const char* kReadAgain = "fetch or export the file again";

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

std::vector<float> gsiSamples(GDALDataset& dataset) {
    const std::vector<unsigned char> bytes = gsiBytes(dataset);
    std::vector<float> heights(static_cast<std::size_t>(kGsiSide) * kGsiSide);
    for (std::size_t k = 0; k < heights.size(); ++k)
        heights[k] = static_cast<float>(gsiHeight(bytes[3 * k], bytes[3 * k + 1], bytes[3 * k + 2]));
    return heights;
}

// Heights of the rows that were read, and what is to be known of all.
struct Tally {
    double low = std::numeric_limits<double>::infinity(), high = -low;  // metres
    double rounded = 0;                                                 // the most that a float lost, metres
    long long customary = 0;   // of the value that often stands for missing samples
    double lowestOther = low;  // without those
};

constexpr double kCustomary = -9999;

void tally(double metres, float kept, Tally& all) {
    all.low = std::min(all.low, metres), all.high = std::max(all.high, metres);
    all.rounded = std::max(all.rounded, std::abs(metres - kept));
    if (metres == kCustomary)
        ++all.customary;
    else
        all.lowestOther = std::min(all.lowestOther, metres);
}

// Relief that floats would turn to steps: refused, as it would be other ground.
void checkPrecision(const std::filesystem::path& file, const Tally& all) {
    constexpr double kLeastLoss_m = 0.01, kShare = 1e-3;
    if (all.rounded <= std::max(kLeastLoss_m, kShare * (all.high - all.low))) return;
    throw Error(
        file.string(), "heights",
        fmt::format(
            "expected relief that single precision holds, got {:.12g} to {:.12g} m, rounded by {:.2g} m",
            all.low, all.high, all.rounded),
        "subtract a constant from all heights");
}

// -9999 alone far below all other ground, in a file that names no value for missing samples, is one.
void dropCustomary(const Tally& all, const HeightBand& band, DemSamples& samples) {
    constexpr double kFarBelow_m = 1000;
    if (all.customary == 0 || band.nodata || band.masked || !(all.lowestOther > kCustomary + kFarBelow_m))
        return;
    for (float& h : samples.heights)
        if (h == static_cast<float>(kCustomary)) h = kMissing;
    samples.missing = "-9999, as is customary: the file names none, and no other height is near it";
}

DemSamples readBand(GDALDataset& dataset, const HeightBand& heightBand, GdalMessages& messages,
                    const std::filesystem::path& file, Tally& all, Progress& progress) {
    GDALRasterBand& band = *dataset.GetRasterBand(heightBand.number);
    const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize();
    int blockWidth = 0, blockHeight = 0;
    band.GetBlockSize(&blockWidth, &blockHeight);
    const int run = std::clamp(blockHeight, 16, 256);
    messages.clear();  // a georeference that GDAL could not make sense of is no damage to the samples
    std::vector<double> stored(static_cast<std::size_t>(width) * run);
    std::vector<unsigned char> mask(heightBand.masked ? stored.size() : 0);
    std::vector<float> heights(static_cast<std::size_t>(width) * height);
    for (int row = 0; row < height; row += run) {
        progress.report(double(row) / height, "reading " + file.filename().string());
        const int rows = std::min(run, height - row);
        CPLErr failed = band.RasterIO(GF_Read, 0, row, width, rows, stored.data(), width, rows, GDT_Float64,
                                      0, 0, nullptr);
        if (heightBand.masked && failed == CE_None)
            failed = band.GetMaskBand()->RasterIO(GF_Read, 0, row, width, rows, mask.data(), width, rows,
                                                  GDT_Byte, 0, 0, nullptr);
        if (failed != CE_None || messages.hasError()) throwCutOff(file, row, height, messages);
        float* out = &heights[static_cast<std::size_t>(row) * width];
        for (std::size_t k = 0; k < static_cast<std::size_t>(width) * rows; ++k) {
            const bool hidden = heightBand.masked && mask[k] == 0;
            const double metres =
                hidden ? std::numeric_limits<double>::quiet_NaN() : heightBand.metres(stored[k]);
            out[k] = static_cast<float>(metres);
            if (!std::isnan(metres)) tally(metres, out[k], all);
        }
    }
    return {std::move(heights), heightBand.chosen, heightBand.unit, heightBand.missing};
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

DemSamples readSamples(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                       double verticalScale, Progress& progress) {
    DemSamples samples;
    Tally all;
    if (isGsiTile(dataset)) {
        samples = {gsiSamples(dataset), "", "", "of the tile's own code"};
        for (const float h : samples.heights)
            if (!std::isnan(h)) tally(h, h, all);
    } else {
        const HeightBand band = heightBandOf(dataset, file);
        samples = readBand(dataset, band, messages, file, all, progress);
        checkPrecision(file, all);
        dropCustomary(all, band, samples);
    }
    if (all.low <= all.high) checkScaledHeights(file.string(), all.low, all.high, verticalScale);
    if (verticalScale != 1)
        for (float& h : samples.heights) h = static_cast<float>(h * verticalScale);
    return samples;
}

}  // namespace stereonav
