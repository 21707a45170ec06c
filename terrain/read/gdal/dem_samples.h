// The samples of an elevation raster as stored, with missing values found, and unit and scale applied. The
// first part of readDem() and of DemRows; the others place them on a grid in metres.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/height_band.h"
#include "terrain/read/gdal/height_convert.h"

namespace stereonav {

// A part of a raster, in its own pixels: columns from x, rows from y.
struct SampleWindow {
    int x = 0, y = 0, width = 0, height = 0;
    long long samples() const { return static_cast<long long>(width) * height; }
};

// The band of heights, read in windows, in the raster's own row order. For one thread. Samples that are read
// are counted for decisions that need all of them.
class HeightSamples {
public:
    // dataset must outlive the object. Throws Error when the raster holds no elevations.
    HeightSamples(GDALDataset& dataset, const std::filesystem::path& file);

    const HeightBand& band() const { return mBand; }
    // Returns in words what marks missing samples.
    const std::string& missing() const { return mMissing; }
    int width() const { return mWidth; }
    int height() const { return mHeight; }
    // Return the size of the file's blocks in samples.
    int blockWidth() const { return mBlockWidth; }
    int blockHeight() const { return mBlockHeight; }

    // Reads the heights of a window within the raster: metres, NaN where missing. Throws Error for a file
    // that is cut off.
    void read(const SampleWindow& window, GdalMessages& messages, float* heights);
    // Reads like read(), but does not count the samples.
    void readUncounted(const SampleWindow& window, GdalMessages& messages, float* heights);

    // Returns whether the file names no value for missing samples, but has -9999 far below all other ground.
    // Then that value counts as missing from now on.
    bool findCustomary();
    // Sets such samples to NaN in heights that were read before.
    void dropCustomary(float* heights, std::size_t count) const;

    // To be called after all samples were read. Throws Error for relief that single precision would turn into
    // steps.
    void checkPrecision() const;
    const HeightTally& tally() const { return mTally; }
    bool allMissing() const;

private:
    void readInto(const SampleWindow& window, GdalMessages& messages, float* heights, HeightTally& tally);

    GDALDataset& mDataset;
    std::filesystem::path mFile;
    HeightBand mBand;
    HeightConversion mConversion;
    std::string mMissing;
    int mWidth, mHeight, mBlockWidth = 0, mBlockHeight = 0;
    std::vector<unsigned char> mStored, mMask;  // samples of a window
    HeightTally mTally;
    bool mCustomaryIsMissing = false;
};

struct DemSamples {
    std::vector<float>
        heights;  // metres times the vertical scale, in the raster's own row order, NaN where missing
    // Guesses about what the file does not say, in words for the user; "" where there was nothing to guess.
    std::string band;     // the band that is read, of several
    std::string unit;     // unit of the heights, where it is not plain metres
    std::string missing;  // what marks missing samples
};

// Reads all samples. Throws Error when the raster holds no elevations, can not be read, or its heights times
// the vertical scale are out of range for floats (height_limits.h); Cancelled.
DemSamples readSamples(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                       double verticalScale, Progress& progress);

// Throws Error that all of the `samples` samples are missing. missing: what marks them.
[[noreturn]] void throwAllMissing(const std::filesystem::path& file, long long samples,
                                  const std::string& missing);

}  // namespace stereonav
