// Loops over stored numbers; see the header. Each gives what HeightBand::metres() says of each number.
#include "terrain/read/gdal/height_convert.h"

#include <algorithm>
#include <cmath>

#include "terrain/read/height_limits.h"

namespace stereonav {
namespace {

constexpr float kNoHeight = std::numeric_limits<float>::quiet_NaN();
constexpr int kNoShort = 1 << 20;

// A tally of numbers that floats hold as they are.
struct FloatTally {
    float low = std::numeric_limits<float>::infinity(), high = -low, lowestOther = low;
    bool customary = false;

    void count(float height) {
        low = height < low ? height : low;
        high = height > high ? height : high;
        const bool other = height != static_cast<float>(kCustomaryMissing);
        customary |= !other;
        lowestOther = other && height < lowestOther ? height : lowestOther;
    }
    void addTo(HeightTally& all) const {
        all.low = std::min<double>(all.low, low), all.high = std::max<double>(all.high, high);
        all.lowestOther = std::min<double>(all.lowestOther, lowestOther);
        all.customary |= customary;
    }
};

}  // namespace

void HeightTally::count(double metres, float kept) {
    low = std::min(low, metres), high = std::max(high, metres);
    rounded = std::max(rounded, std::abs(metres - kept));
    if (metres == kCustomaryMissing)
        customary = true;
    else
        lowestOther = std::min(lowestOther, metres);
}

HeightConversion::HeightConversion(GDALDataType stored, const HeightBand& band)
    : mBand(band), mType(GDT_Float64), mMissingShort(kNoShort) {
    if (band.masked || band.scale != 1 || band.offset != 0) return;
    if (stored == GDT_Int16 || stored == GDT_Float32) mType = stored;
    if (!band.nodata) return;
    const double nodata = *band.nodata;
    if (nodata >= -32768 && nodata <= 32767 && nodata == std::floor(nodata))
        mMissingShort = static_cast<int>(nodata);
    if (std::abs(nodata) <= std::numeric_limits<float>::max()) mMissingFloat = static_cast<float>(nodata);
}

std::size_t HeightConversion::bytes() const {
    return static_cast<std::size_t>(GDALGetDataTypeSizeBytes(mType));
}

void HeightConversion::convert(const void* stored, const unsigned char* mask, std::size_t count,
                               float* heights, HeightTally& tally) const {
    if (mType == GDT_Int16)
        convertShorts(static_cast<const short*>(stored), count, heights, tally);
    else if (mType == GDT_Float32)
        convertFloats(static_cast<const float*>(stored), count, heights, tally);
    else
        convertDoubles(static_cast<const double*>(stored), mask, count, heights, tally);
}

void HeightConversion::convertShorts(const short* stored, std::size_t count, float* heights,
                                     HeightTally& tally) const {
    FloatTally found;
    for (std::size_t k = 0; k < count; ++k) {
        const bool missing = stored[k] == mMissingShort;
        const float height = stored[k];
        heights[k] = missing ? kNoHeight : height;
        if (!missing) found.count(height);
    }
    found.addTo(tally);
}

void HeightConversion::convertFloats(const float* stored, std::size_t count, float* heights,
                                     HeightTally& tally) const {
    constexpr float kMost = kMostHeight_m;  // a float as it is
    FloatTally found;
    for (std::size_t k = 0; k < count; ++k) {
        const float height = stored[k] + 0.0f;  // -0 becomes 0, as by an offset of 0
        const bool known = std::abs(height) <= kMost && stored[k] != mMissingFloat;
        heights[k] = known ? height : kNoHeight;
        if (known) found.count(height);
    }
    found.addTo(tally);
}

void HeightConversion::convertDoubles(const double* stored, const unsigned char* mask, std::size_t count,
                                      float* heights, HeightTally& tally) const {
    for (std::size_t k = 0; k < count; ++k) {
        const bool hidden = mask && mask[k] == 0;
        const double metres = hidden ? std::numeric_limits<double>::quiet_NaN() : mBand.metres(stored[k]);
        heights[k] = static_cast<float>(metres);
        if (!std::isnan(metres)) tally.count(metres, heights[k]);
    }
}

}  // namespace stereonav
