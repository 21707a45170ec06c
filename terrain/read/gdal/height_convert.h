// Converts stored numbers of a band of heights to metres, and collects statistics over all of them.
#pragma once

#include <gdal_priv.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "terrain/read/gdal/height_band.h"

namespace stereonav {

// The value that often stands for missing samples where a file names none.
constexpr double kCustomaryMissing = -9999;
// Distance in metres by which all heights must lie above it, if it stands for missing samples.
constexpr double kFarBelowAll_m = 1000;

// Statistics of the known heights, in metres. Counting some of them twice changes no decision.
struct HeightTally {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    double rounded = 0;        // largest rounding error of a float
    bool customary = false;    // whether the customary value is among them
    double lowestOther = low;  // lowest height other than the customary value

    bool anyKnown() const { return low <= high; }
    void count(double metres, float kept);
};

// Converts heights in their stored type where that is as exact as double precision: int16 and float32 without
// scale, offset and mask, which most files have.
class HeightConversion {
public:
    HeightConversion(GDALDataType stored, const HeightBand& band);

    GDALDataType type() const { return mType; }
    std::size_t bytes() const;  // bytes of a stored number

    // Converts `count` numbers of type(). mask: 0 where a sample is missing, null where the band has none.
    // Writes NaN where missing.
    void convert(const void* stored, const unsigned char* mask, std::size_t count, float* heights,
                 HeightTally& tally) const;

private:
    void convertShorts(const short* stored, std::size_t count, float* heights, HeightTally& tally) const;
    void convertFloats(const float* stored, std::size_t count, float* heights, HeightTally& tally) const;
    void convertDoubles(const double* stored, const unsigned char* mask, std::size_t count, float* heights,
                        HeightTally& tally) const;

    HeightBand mBand;
    GDALDataType mType;
    int mMissingShort = 0;  // a value out of the range of int16 where none is missing
    float mMissingFloat = std::numeric_limits<float>::quiet_NaN();
};

}  // namespace stereonav
