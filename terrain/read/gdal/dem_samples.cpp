// Elevation samples through GDAL, a run of rows at a time.
#include "terrain/read/gdal/dem_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "terrain/read/gdal/coded_tile.h"
#include "terrain/read/gdal/dem_open.h"
#include "terrain/read/height_limits.h"

namespace stereonav {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr const char* kReadAgain = "fetch or export the file again";

[[noreturn]] void throwCutOff(const std::filesystem::path& file, int row, int rows,
                              const GdalMessages& messages) {
    messages.throwIfRefused(file);
    const std::string reason = messages.reason(file);
    if (const std::filesystem::path part = damagedFileIn(file); !part.empty())
        throw Error(part.string(), "", "the file is cut off or damaged" + reason, kReadAgain);
    throw Error(file.string(), fmt::format("row {} of {}", row + 1, rows),
                "the file is cut off or damaged" + reason, kReadAgain);
}

// All of it, a run of rows at a time.
std::vector<float> readAll(HeightSamples& samples, GdalMessages& messages, const std::filesystem::path& file,
                           Progress& progress) {
    const int width = samples.width(), height = samples.height(),
              run = std::clamp(samples.blockHeight(), 16, 256);
    std::vector<float> heights(static_cast<std::size_t>(width) * height);
    for (int row = 0; row < height; row += run) {
        progress.report(double(row) / height, "reading " + file.filename().string());
        samples.read({0, row, width, std::min(run, height - row)}, messages,
                     &heights[static_cast<std::size_t>(row) * width]);
    }
    return heights;
}

// Returns the band. In a folder the reader itself chooses what stands for missing samples, so no value is
// named.
HeightBand bandAsNamed(GDALDataset& dataset, const std::filesystem::path& file) {
    HeightBand band = heightBandOf(dataset, file);
    std::error_code failed;
    if (!std::filesystem::is_directory(file, failed)) return band;
    band.nodata.reset();
    band.missing.clear();
    return band;
}

}  // namespace

HeightSamples::HeightSamples(GDALDataset& dataset, const std::filesystem::path& file)
    : mDataset(dataset),
      mFile(file),
      mBand(bandAsNamed(dataset, file)),
      mConversion(dataset.GetRasterBand(mBand.number)->GetRasterDataType(), mBand),
      mMissing(mBand.missing),
      mWidth(dataset.GetRasterXSize()),
      mHeight(dataset.GetRasterYSize()) {
    dataset.GetRasterBand(mBand.number)->GetBlockSize(&mBlockWidth, &mBlockHeight);
}

void HeightSamples::read(const SampleWindow& window, GdalMessages& messages, float* heights) {
    readInto(window, messages, heights, mTally);
}

void HeightSamples::readUncounted(const SampleWindow& window, GdalMessages& messages, float* heights) {
    HeightTally none;
    readInto(window, messages, heights, none);
}

void HeightSamples::readInto(const SampleWindow& window, GdalMessages& messages, float* heights,
                             HeightTally& tally) {
    GDALRasterBand& band = *mDataset.GetRasterBand(mBand.number);
    messages.clear();  // a georeference that GDAL could not make sense of is no damage to the samples
    const auto count = static_cast<std::size_t>(window.samples());
    mStored.resize(count * mConversion.bytes());
    mMask.resize(mBand.masked ? count : 0);
    const auto fetch = [&](GDALRasterBand& from, void* out, GDALDataType type) {
        return from.RasterIO(GF_Read, window.x, window.y, window.width, window.height, out, window.width,
                             window.height, type, 0, 0, nullptr) == CE_None;
    };
    const bool fetched = fetch(band, mStored.data(), mConversion.type()) &&
                         (!mBand.masked || fetch(*band.GetMaskBand(), mMask.data(), GDT_Byte));
    if (!fetched || messages.hasError()) throwCutOff(mFile, window.y, band.GetYSize(), messages);
    mConversion.convert(mStored.data(), mBand.masked ? mMask.data() : nullptr, count, heights, tally);
    if (mCustomaryIsMissing) dropCustomary(heights, count);
}

bool HeightSamples::findCustomary() {
    if (!mTally.customary || mBand.nodata || mBand.masked ||
        !(mTally.lowestOther > kCustomaryMissing + kFarBelowAll_m))
        return false;
    mCustomaryIsMissing = true;
    mMissing = "-9999, by convention: the file names none, and no other height is near it";
    return true;
}

void HeightSamples::dropCustomary(float* heights, std::size_t count) const {
    for (float* h = heights; h != heights + count; ++h)
        if (*h == static_cast<float>(kCustomaryMissing)) *h = kMissing;
}

void HeightSamples::checkPrecision() const {
    constexpr double kLeastLoss_m = 0.01, kShare = 1e-3;
    if (mTally.rounded <= std::max(kLeastLoss_m, kShare * (mTally.high - mTally.low))) return;
    throw Error(
        mFile.string(), "heights",
        fmt::format(
            "expected heights that single precision can hold, got {:.12g} to {:.12g} m, rounded by {:.2g} m",
            mTally.low, mTally.high, mTally.rounded),
        "subtract a constant from all heights");
}

bool HeightSamples::allMissing() const {
    return !mTally.anyKnown() || (mCustomaryIsMissing && !(mTally.lowestOther <= mTally.high));
}

DemSamples readSamples(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                       double verticalScale, Progress& progress) {
    const std::string doing = "reading " + file.filename().string();
    progress.report(0, doing);
    DemSamples samples;
    HeightTally all;
    if (const TileCode code = codedTileOf(dataset, file).code; code != TileCode::None) {
        samples = {codedHeights(dataset, code), "", "", "of the tile's own code"};
        for (const float h : samples.heights)
            if (!std::isnan(h)) all.count(h, h);
    } else {
        HeightSamples band(dataset, file);
        samples.heights = readAll(band, messages, file, progress);
        band.checkPrecision();
        if (band.findCustomary()) band.dropCustomary(samples.heights.data(), samples.heights.size());
        samples.band = band.band().chosen, samples.unit = band.band().unit, samples.missing = band.missing();
        all = band.tally();
    }
    if (all.anyKnown()) checkScaledHeights(file.string(), all.low, all.high, verticalScale);
    if (verticalScale != 1)
        for (float& h : samples.heights) h = static_cast<float>(h * verticalScale);
    progress.report(1, doing);
    return samples;
}

void throwAllMissing(const std::filesystem::path& file, long long samples, const std::string& missing) {
    throw Error(file.string(), "",
                fmt::format("all {} samples are missing{}", samples,
                            missing.empty() ? "" : " (nodata " + missing + ")"),
                "check the file's nodata value");
}

}  // namespace stereonav
