// Elevation samples through GDAL, a run of rows at a time.
#include "terrain/read/gdal/dem_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
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

constexpr double kCustomary = -9999;
constexpr const char* kCustomaryMissing =
    "-9999, as is customary: the file names none, and no other height is near it";

// Whether floats hold all values of the type, and the band's numbers are metres as they are.
bool floatsHold(GDALRasterBand& band, const HeightBand& heights) {
    if (heights.scale != 1 || heights.offset != 0 || heights.signedBytes) return false;
    switch (band.GetRasterDataType()) {
        case GDT_Byte:
        case GDT_UInt16:
        case GDT_Int16:
        case GDT_Float32:
            return true;
        default:
            return false;
    }
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

std::vector<float> gsiSamples(GDALDataset& dataset) {
    const std::vector<unsigned char> bytes = gsiBytes(dataset);
    std::vector<float> heights(static_cast<std::size_t>(kGsiSide) * kGsiSide);
    for (std::size_t k = 0; k < heights.size(); ++k)
        heights[k] = static_cast<float>(gsiHeight(bytes[3 * k], bytes[3 * k + 1], bytes[3 * k + 2]));
    return heights;
}

void SampleRows::Tally::add(double metres, float kept) {
    low = std::min(low, metres), high = std::max(high, metres);
    rounded = std::max(rounded, std::abs(metres - kept));
    if (metres == kCustomary)
        ++customary;
    else
        lowestOther = std::min(lowestOther, metres);
}

void SampleRows::Tally::add(const Tally& other) {
    low = std::min(low, other.low), high = std::max(high, other.high);
    rounded = std::max(rounded, other.rounded);
    customary += other.customary;
    lowestOther = std::min(lowestOther, other.lowestOther);
}

SampleRows::SampleRows(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file)
    : SampleRows(dataset, messages, file, heightBandOf(dataset, file)) {}

SampleRows::SampleRows(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                       HeightBand heights)
    : mDataset(dataset), mMessages(messages), mFile(file), mBand(std::move(heights)) {
    GDALRasterBand& band = *dataset.GetRasterBand(mBand.number);
    int blockWidth = 0, blockHeight = 0;
    band.GetBlockSize(&blockWidth, &blockHeight);
    // Whole blocks where they are not too high.
    mRun = blockHeight < 16 ? 16 / std::max(blockHeight, 1) * std::max(blockHeight, 1) : blockHeight;
    mRun = std::clamp(mRun, 1, 256);
    mFloats = floatsHold(band, mBand);
    messages.clear();  // a georeference that GDAL could not make sense of is no damage to the samples
}

void SampleRows::read(int row, int rows, float* heights) {
    mFloats ? readAs(row, rows, heights, mStoredFloats) : readAs(row, rows, heights, mStored);
}

template <typename Stored>
void SampleRows::readAs(int row, int rows, float* heights, std::vector<Stored>& stored) {
    GDALRasterBand& band = *mDataset.GetRasterBand(mBand.number);
    const int width = mDataset.GetRasterXSize(), height = mDataset.GetRasterYSize();
    const std::size_t count = static_cast<std::size_t>(width) * rows;
    if (stored.size() < count) stored.resize(count);
    if (mBand.masked && mMask.size() < count) mMask.resize(count);
    constexpr GDALDataType kType = sizeof(Stored) == sizeof(float) ? GDT_Float32 : GDT_Float64;
    CPLErr failed =
        band.RasterIO(GF_Read, 0, row, width, rows, stored.data(), width, rows, kType, 0, 0, nullptr);
    if (mBand.masked && failed == CE_None)
        failed = band.GetMaskBand()->RasterIO(GF_Read, 0, row, width, rows, mMask.data(), width, rows,
                                              GDT_Byte, 0, 0, nullptr);
    if (failed != CE_None || mMessages.hasError()) throwCutOff(mFile, row, height, mMessages);
    std::vector<Tally> tallies(static_cast<std::size_t>(rows));
    parallelFor(rows, [&](int j) {
        Tally tally;
        const std::size_t first = static_cast<std::size_t>(j) * width;
        for (std::size_t k = first; k < first + width; ++k) {
            const bool hidden = mBand.masked && mMask[k] == 0;
            double metres =
                hidden ? std::numeric_limits<double>::quiet_NaN() : mBand.metres(double(stored[k]));
            if (mLeavesOutCustomary && metres == kCustomary)
                metres = std::numeric_limits<double>::quiet_NaN();
            heights[k] = static_cast<float>(metres);
            if (!std::isnan(metres)) tally.add(metres, heights[k]);
        }
        tallies[static_cast<std::size_t>(j)] = tally;
    });
    for (const Tally& tally : tallies) mTally.add(tally);
}

bool SampleRows::holdsCustomary() const {
    constexpr double kFarBelow_m = 1000;
    return mTally.customary > 0 && !mBand.nodata && !mBand.masked &&
           mTally.lowestOther > kCustomary + kFarBelow_m && !mLeavesOutCustomary;
}

// Relief that floats would turn to steps is refused: it would be other ground.
void SampleRows::check(double verticalScale) const {
    constexpr double kLeastLoss_m = 0.01, kShare = 1e-3;
    if (mTally.rounded > std::max(kLeastLoss_m, kShare * (mTally.high - mTally.low)))
        throw Error(mFile.string(), "heights",
                    fmt::format("expected relief that single precision holds, got {:.12g} to {:.12g} m, "
                                "rounded by {:.2g} m",
                                mTally.low, mTally.high, mTally.rounded),
                    "subtract a constant from all heights");
    if (anyKnown()) checkScaledHeights(mFile.string(), mTally.low, mTally.high, verticalScale);
}

namespace {

DemSamples samplesOfBand(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                         double verticalScale, Progress& progress) {
    SampleRows rows(dataset, messages, file);
    const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize();
    DemSamples samples{{}, rows.band().chosen, rows.band().unit, rows.band().missing};
    samples.heights.resize(static_cast<std::size_t>(width) * height);
    for (int row = 0; row < height; row += rows.runOfRows()) {
        progress.report(double(row) / height, "reading " + file.filename().string());
        rows.read(row, std::min(rows.runOfRows(), height - row),
                  &samples.heights[static_cast<std::size_t>(row) * width]);
    }
    rows.check(verticalScale);
    if (!rows.holdsCustomary()) return samples;
    for (float& h : samples.heights)
        if (h == static_cast<float>(kCustomary)) h = kMissing;
    samples.missing = kCustomaryMissing;
    return samples;
}

}  // namespace

DemSamples readSamples(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                       double verticalScale, Progress& progress) {
    DemSamples samples;
    if (isGsiTile(dataset)) {
        samples = {gsiSamples(dataset), "", "", "of the tile's own code"};
        SampleRows::Tally all;
        for (const float h : samples.heights)
            if (!std::isnan(h)) all.add(h, h);
        if (all.low <= all.high) checkScaledHeights(file.string(), all.low, all.high, verticalScale);
    } else {
        samples = samplesOfBand(dataset, messages, file, verticalScale, progress);
    }
    if (verticalScale != 1)
        for (float& h : samples.heights) h = static_cast<float>(h * verticalScale);
    return samples;
}

}  // namespace stereonav
