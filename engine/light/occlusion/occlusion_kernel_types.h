// Arguments of the filters of occlusion_kernel.cpp: plain numbers and memory only, since they are compiled
// for several instruction sets.
//
// A band of rows goes through in two steps. Each slice is filtered along j and i into the band's boxes; then
// each row's boxes, of all slices, along k, which also makes the result.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stereonav {

enum class BoxResult { Reconstructed, DrawnIn, Gaussian, Chebyshev, Variance };

// Columns that extrema are sought for at a time, so that a window of them stays in the nearest cache; rows of
// boxes are padded to whole strips. A multiple of the lanes of every kernel.
constexpr int kOcclusionStrip = 64;

// A band of rows of the volume, and the boxes that it goes through.
struct OcclusionBand {
    const std::int16_t* values = nullptr;  // the volume, i fastest
    std::uint8_t* to = nullptr;            // the same grid
    int size[3] = {0, 0, 0};
    int radius[3] = {0, 0, 0};  // below `size`: what is farther is outside anyway
    int first = 0, end = 0;     // the band's rows
    BoxResult result = BoxResult::Reconstructed;
    bool turned = false;    // smaller values are the denser ones
    float perVariance = 0;  // Variance: result, 0 to 1, a squared stored number
    float beta = 0;         // Reconstructed: the exponent; 0: that of the mean
    float deviations = 3;   // DrawnIn: standard deviations from the mean to its ends, at most

    // Boxes of one voxel along k: [(j - first) * size[2] + k] rows of `stride`. Extrema for Reconstructed,
    // squares for the others, both for DrawnIn.
    int stride = 0;
    std::int32_t* sums = nullptr;
    std::int16_t *lows = nullptr, *highs = nullptr;
    double* squares = nullptr;  // whole numbers below 2^53

    const double* columnCounts = nullptr;  // stride: voxels of the box along i

    // Sums along j of the band's last row, by slice, from which the next band goes on: rows of `stride`.
    std::int32_t* lastSums = nullptr;
    std::int64_t* lastSquares = nullptr;

    std::ptrdiff_t boxRow(int j, int k) const {
        return (static_cast<std::ptrdiff_t>(j - first) * size[2] + k) * stride;
    }
    bool extrema() const { return result == BoxResult::Reconstructed || result == BoxResult::DrawnIn; }
    bool moments() const { return result != BoxResult::Reconstructed; }
};

// Working memory of one thread; a padded row has stride + 2 * kMostOcclusionRadius + 1 numbers.
struct OcclusionScratch {
    std::int16_t *suffixLows, *suffixHighs;  // largest window * strip
    std::int16_t *runLows, *runHighs;        // strip
    std::int16_t *lows, *highs;              // padded row
    std::uint32_t* prefix;                   // padded row
    std::uint64_t* squaresPrefix;            // padded row
    double *total, *totalSquares;            // strip
    std::int32_t *value, *low, *high, *out;  // strip
};

struct OcclusionKernels {
    void (*filterSlice)(const OcclusionBand& band, int k, const OcclusionScratch& scratch);
    void (*finishRow)(const OcclusionBand& band, int j, const OcclusionScratch& scratch);
};

}  // namespace stereonav
