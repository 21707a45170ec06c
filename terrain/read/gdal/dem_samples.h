// The samples of an elevation raster as stored: missing values found, units and scale applied. The first part
// of readDem() and of DemRows; the others place them on a grid in metres.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/height_band.h"
#include "terrain/read/gdal/height_convert.h"

namespace stereonav {

// A part of a raster, in its own samples: columns from x, rows from y.
struct SampleWindow {
    int x = 0, y = 0, width = 0, height = 0;
    long long samples() const { return static_cast<long long>(width) * height; }
};

// The band of heights, a window at a time, in the raster's own row order. To one thread. What it reads is
// counted for what only all samples tell.
class HeightSamples {
public:
    // dataset must outlive the object. Throws Error when the raster holds no elevations.
    HeightSamples(GDALDataset& dataset, const std::filesystem::path& file);

    const HeightBand& band() const { return mBand; }
    // Returns in words what marks missing samples.
    const std::string& missing() const { return mMissing; }
    int width() const { return mWidth; }
    int height() const { return mHeight; }
    // Samples of the blocks that the file has, along each side.
    int blockWidth() const { return mBlockWidth; }
    int blockHeight() const { return mBlockHeight; }

    // Reads the heights of a window within the raster: metres, NaN where missing. Throws Error for a file
    // that is cut off.
    void read(const SampleWindow& window, GdalMessages& messages, float* heights);
    // Reads as read() does, but leaves the samples out of the counts.
    void readUncounted(const SampleWindow& window, GdalMessages& messages, float* heights);

    // Returns whether -9999 alone far below all other ground was found in a file that names no value for
    // missing samples: then it is one, and from here on missing where it is read. That is how it stays.
    bool findCustomary();
    // For heights that were read before.
    void dropCustomary(float* heights, std::size_t count) const;

    // Called after all was read. Throws Error for relief that floats would turn to steps: it would be other
    // ground.
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
    // Guesses about things that the file does not say, in words for a person; "" where there is nothing to
    // say.
    std::string band;     // the band that is read, of several
    std::string unit;     // unit of the heights, where they are not plain metres
    std::string missing;  // what marks missing samples
};

// Throws Error when the raster holds no elevations, can not be read, or its heights times the vertical scale
// are beyond what floats hold (height_limits.h); Cancelled.
DemSamples readSamples(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                       double verticalScale, Progress& progress);

// Throws Error: all of the `samples` samples are missing. missing: how that is marked.
[[noreturn]] void throwAllMissing(const std::filesystem::path& file, long long samples,
                                  const std::string& missing);

}  // namespace stereonav
