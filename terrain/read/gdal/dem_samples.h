// The samples of an elevation raster as stored: missing values found, units and scale applied.
// The first part of readDem(); the others place them on a grid in metres.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/height_band.h"

namespace stereonav {

// Whether the raster is a GSI elevation tile: 256x256, three or four 8-bit bands, not JPEG, and every
// pixel decodes to a height between -500 and 9,000 m or to nodata; a photo does not.
bool isGsiTile(GDALDataset& dataset);

// The heights of a raster's band, a run of rows at a time. To one thread.
class SampleRows {
public:
    // messages, dataset: outlive it. Throws Error as heightBandOf().
    SampleRows(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file);
    // band: how its numbers are meant.
    SampleRows(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
               HeightBand band);

    const HeightBand& band() const { return mBand; }
    int runOfRows() const { return mRun; }  // whole blocks, 16 to 256 rows
    // Rows row to row + rows - 1 of the raster, in its own order: metres, NaN where missing. Throws Error
    // where the file is cut off.
    void read(int row, int rows, float* heights);

    // Of all rows that were read: whether -9999 alone, far below all else, in a file that names no value for
    // missing samples, is one.
    bool holdsCustomary() const;
    // From now on it is missing in what is read.
    void leaveOutCustomary() { mLeavesOutCustomary = true; }
    // Throws Error where heights that were read are not what floats hold, or times the scale leave their
    // range.
    void check(double verticalScale) const;
    bool anyKnown() const { return mTally.low <= mTally.high; }

    // Heights of the rows that were read, and what is to be known of all.
    struct Tally {
        double low = std::numeric_limits<double>::infinity(), high = -low;  // metres
        double rounded = 0;        // the most that a float lost, metres
        long long customary = 0;   // of the value that often stands for missing samples
        double lowestOther = low;  // without those
        void add(double metres, float kept);
        void add(const Tally& other);
    };

private:
    template <typename Stored>
    void readAs(int row, int rows, float* heights, std::vector<Stored>& stored);

    GDALDataset& mDataset;
    GdalMessages& mMessages;
    std::filesystem::path mFile;
    HeightBand mBand;
    int mRun = 16;
    bool mFloats = false;  // floats hold all that is stored
    bool mLeavesOutCustomary = false;
    std::vector<float> mStoredFloats;
    std::vector<double> mStored;
    std::vector<unsigned char> mMask;
    Tally mTally;
};

// Metres of a GSI elevation tile, which the raster is.
std::vector<float> gsiSamples(GDALDataset& dataset);

struct DemSamples {
    std::vector<float>
        heights;  // metres times the vertical scale, in the raster's own row order, NaN where missing
    // What the file left to be found out, in words for a person; "" where there is nothing to say.
    std::string band;     // which of several bands
    std::string unit;     // of the heights, where they are not plain metres
    std::string missing;  // what marks missing samples
};

// Throws Error when the raster holds no elevations, can not be read, or its heights times the vertical scale
// are beyond what floats hold (height_limits.h); Cancelled.
DemSamples readSamples(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                       double verticalScale, Progress& progress);

}  // namespace stereonav
