// What the filters of occlusion_kernel.cpp are given: plain numbers and memory only, since they are compiled
// for several instruction sets.
//
// A band of rows goes through in two steps. Each slice is filtered along j and i into the band's boxes; then
// each row's boxes, of all slices, along k, which also makes the result.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stereonav {

enum class BoxResult { Reconstructed, Gaussian, Chebyshev, Variance };

// Rows of boxes are padded to whole chunks: the most lanes that a kernel has.
constexpr int kOcclusionChunk = 16;

struct OcclusionBand {
    const std::int16_t* values = nullptr;  // the volume, i fastest
    std::uint8_t* to = nullptr;            // the same grid
    int size[3] = {0, 0, 0};
    int radius[3] = {0, 0, 0};  // below `size`: what is farther is outside anyway
    int first = 0, end = 0;     // the band's rows
    BoxResult result = BoxResult::Reconstructed;
    bool turned = false;    // smaller values are the denser ones
    float perVariance = 0;  // Variance: result a squared stored number

    // Boxes of one voxel along k: [(j - first) * size[2] + k] rows of `stride`. Extrema for Reconstructed,
    // squares for the others.
    int stride = 0;
    std::int32_t* sums = nullptr;
    std::int16_t *lows = nullptr, *highs = nullptr;
    double* squares = nullptr;  // whole numbers below 2^53

    const double* columnCounts = nullptr;  // stride: voxels of the box along i

    std::ptrdiff_t boxRow(int j, int k) const {
        return (static_cast<std::ptrdiff_t>(j - first) * size[2] + k) * stride;
    }
    bool extrema() const { return result == BoxResult::Reconstructed; }
};

// Working memory of one thread; `row` is the padded row: stride + 2 * 64 + kOcclusionChunk numbers.
struct OcclusionScratch {
    std::int16_t *suffixLows, *suffixHighs;  // largest window * stride
    std::int16_t *lows, *highs;              // row
    std::int16_t *runLows, *runHighs;        // stride
    std::int32_t* sums;                      // stride
    std::uint32_t* prefix;                   // row
    std::int64_t* squares;                   // stride
    std::uint64_t* squaresPrefix;            // row
    double *total, *totalSquares;            // stride
    std::int32_t *value, *low, *high, *out;  // stride
};

struct OcclusionKernels {
    void (*filterSlice)(const OcclusionBand& band, int k, const OcclusionScratch& scratch);
    void (*finishRow)(const OcclusionBand& band, int j, const OcclusionScratch& scratch);
};

}  // namespace stereonav
