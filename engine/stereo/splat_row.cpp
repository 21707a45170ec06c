// Splats of a row, right to left, so that what is in front comes first and takes its share of each
// subpixel; what is left of the share goes to the splats behind.
#include "engine/stereo/splat_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stereonav {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

// Opacity at the centres of a splat's subpixels.
std::array<float, kSplatWidth> makeKernel() {
    std::array<float, kSplatWidth> kernel{};
    for (int k = 0; k < kSplatWidth; ++k) {
        const float x = (static_cast<float>(k) + 0.5f) / kSubpixels - 1.0f;  // pixels
        kernel[k] = std::exp(-x * x / (2 * kSplatSigma * kSplatSigma));
    }
    return kernel;
}

struct Scanline {
    float *weight, *r, *g, *b;
};

Scanline clearScanline(const SplatRow& row) {
    const std::ptrdiff_t size = splatScratchSize(row.width) / 4;
    std::fill_n(row.accumulators, 4 * size, 0.0f);
    return {row.accumulators, row.accumulators + size, row.accumulators + 2 * size,
            row.accumulators + 3 * size};
}

void splat(const Scanline& line, const std::array<float, kSplatWidth>& kernel, float column,
           std::uint32_t color) {
    const int begin =
        static_cast<int>(std::floor(column * kSubpixels + 0.5f)) - kSplatWidth / 2 + kSplatMargin;
    const float r = static_cast<float>(color & 1023u);
    const float g = static_cast<float>(color >> 10 & 1023u);
    const float b = static_cast<float>(color >> 20 & 1023u);
    for (int k = 0; k < kSplatWidth; ++k) {
        const float share = (1.0f - line.weight[begin + k]) * kernel[k];
        line.weight[begin + k] += share;
        line.r[begin + k] += share * r;
        line.g[begin + k] += share * g;
        line.b[begin + k] += share * b;
    }
}

// Depth and source of the (at most two) pixels whose centres the splat reaches.
void noteSplat(const SplatRow& row, float column, int i) {
    const int first = static_cast<int>(std::floor(column - 0.5f));
    for (int p = std::max(first, 0); p <= std::min(first + 1, row.width - 1); ++p) {
        row.depth[p] = std::min(row.depth[p], row.leftDepth[i]);
        if (row.source[p] < 0 || std::abs(column - (static_cast<float>(p) + 0.5f)) <= 0.5f) row.source[p] = i;
    }
}

float sumOfPixel(const float* channel, int p) {
    const float* sub = channel + static_cast<std::ptrdiff_t>(p) * kSubpixels + kSplatMargin;
    float sum = 0;
    for (int k = 0; k < kSubpixels; ++k) sum += sub[k];
    return sum;
}

void resolvePixel(const SplatRow& row, const Scanline& line, int p) {
    const float weight = sumOfPixel(line.weight, p);
    const bool hole = !(weight >= row.weightThreshold * kSubpixels && weight > 0) || row.source[p] < 0;
    row.holes[p] = hole ? 255 : 0;
    row.color[p] = 0;
    if (hole) {
        row.depth[p] = 0;
        return;
    }
    const auto channel = [&](const float* sums) {
        return static_cast<std::uint32_t>(std::min(sumOfPixel(sums, p) / weight + 0.5f, 1023.0f));
    };
    row.color[p] = channel(line.r) | channel(line.g) << 10 | channel(line.b) << 20;
}

}  // namespace

void splatRow(const SplatRow& row) {
    static const std::array<float, kSplatWidth> kKernel = makeKernel();
    const Scanline line = clearScanline(row);
    std::fill_n(row.depth, row.width, kFar);
    std::fill_n(row.source, row.width, -1);
    float leftmost = kFar;
    for (int i = row.width - 1; i >= 0; --i) {
        if (row.leftDepth[i] == kFar) continue;  // background has no depth
        const float column = (static_cast<float>(i) + 0.5f) + (row.shift - row.scale / row.leftDepth[i]);
        if (!(column <= static_cast<float>(row.width))) continue;  // region II
        if (column < 0.0f) break;  // region I: all further left is hidden or outside as well
        if (!(column < leftmost)) continue;
        leftmost = column;
        splat(line, kKernel, column, row.leftColor[i]);
        noteSplat(row, column, i);
    }
    for (int p = 0; p < row.width; ++p) resolvePixel(row, line, p);
}

}  // namespace stereonav
