// Stored numbers of a band of heights to metres, and what is to be known of all of them.
#pragma once

#include <gdal_priv.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "terrain/read/gdal/height_band.h"

namespace stereonav {

// The value that often stands for missing samples where a file names none.
constexpr double kCustomaryMissing = -9999;
// How far all heights lie above it where they do.
constexpr double kFarBelowAll_m = 1000;

// A tally of the heights that are there, in metres. Counting some of them twice changes no answer that is
// drawn from it.
struct HeightTally {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    double rounded = 0;        // the most that a float lost
    bool customary = false;    // whether the customary value is among them
    double lowestOther = low;  // without it

    bool anyKnown() const { return low <= high; }
    void count(double metres, float kept);
};

// Converts heights in the type that they are stored in where that is as good as double precision: int16 and
// float32 without scale, offset and mask, which most files are.
class HeightConversion {
public:
    HeightConversion(GDALDataType stored, const HeightBand& band);

    GDALDataType type() const { return mType; }
    std::size_t bytes() const;  // bytes of a stored number

    // count numbers of type(); mask: 0 where a sample is missing, null where the band has none. NaN where
    // missing.
    void convert(const void* stored, const unsigned char* mask, std::size_t count, float* heights,
                 HeightTally& tally) const;

private:
    void convertShorts(const short* stored, std::size_t count, float* heights, HeightTally& tally) const;
    void convertFloats(const float* stored, std::size_t count, float* heights, HeightTally& tally) const;
    void convertDoubles(const double* stored, const unsigned char* mask, std::size_t count, float* heights,
                        HeightTally& tally) const;

    HeightBand mBand;
    GDALDataType mType;
    int mMissingShort = 0;  // no int16 where none is missing
    float mMissingFloat = std::numeric_limits<float>::quiet_NaN();
};

}  // namespace stereonav
