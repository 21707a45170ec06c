#include "engine/volume/value_counts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kNumbers = 65536, kLowestStored = -32768;
constexpr int kBlock = 8;  // voxels along each axis: as coarse is it told what is near

using Counts = std::vector<std::uint64_t>;

// Voxels first to last along an axis.
struct Span {
    int first, last;
};
Span spanOf(int size, int border) {
    return {border, size - 1 - border};
}

bool anyInside(const MaskVolume& mask, const glm::ivec3& low, const glm::ivec3& high) {
    for (int k = low.z; k <= high.z; ++k)
        for (int j = low.y; j <= high.y; ++j) {
            const std::uint8_t* const row = &mask.values[mask.frame.index(low.x, j, k)];
            if (std::any_of(row, row + (high.x - low.x + 1), [](std::uint8_t v) { return v != 0; }))
                return true;
        }
    return false;
}

// The layer of blocks that begins at voxel k.
void countLayer(const GreyVolume& grey, int border, const MaskVolume* near, int k, Counts& counts) {
    const glm::ivec3 size = grey.frame.size;
    const Span x = spanOf(size.x, border), y = spanOf(size.y, border), z = spanOf(size.z, border);
    const int top = std::min(k + kBlock - 1, z.last);
    for (int j = y.first; j <= y.last; j += kBlock)
        for (int i = x.first; i <= x.last; i += near ? kBlock : size.x) {
            const glm::ivec3 low(i, j, k);
            const glm::ivec3 high(near ? std::min(i + kBlock - 1, x.last) : x.last,
                                  std::min(j + kBlock - 1, y.last), top);
            if (near && !anyInside(*near, low, high)) continue;
            for (int c = low.z; c <= high.z; ++c)
                for (int b = low.y; b <= high.y; ++b) {
                    const std::int16_t* const row = &grey.values[grey.frame.index(low.x, b, c)];
                    for (int a = 0; a <= high.x - low.x; ++a)
                        ++counts[static_cast<std::size_t>(row[a] - kLowestStored)];
                }
        }
}

double valueOf(const ValueCounts& counts, std::ptrdiff_t index) {
    return static_cast<double>(index + kLowestStored) * counts.scale + counts.offset;
}

bool some(std::uint64_t count) {
    return count > 0;
}

// Values of the smallest and the largest stored number.
std::array<double, 2> endsOf(const ValueCounts& counts) {
    const auto first = std::find_if(counts.counts.begin(), counts.counts.end(), some);
    if (first == counts.counts.end()) return {0, 0};
    const auto last = std::find_if(counts.counts.rbegin(), counts.counts.rend(), some);
    return {valueOf(counts, first - counts.counts.begin()),
            valueOf(counts, kNumbers - 1 - (last - counts.counts.rbegin()))};
}

}  // namespace

double ValueCounts::lowest() const {
    const auto ends = endsOf(*this);
    return std::min(ends[0], ends[1]);
}

double ValueCounts::highest() const {
    const auto ends = endsOf(*this);
    return std::max(ends[0], ends[1]);
}

ValueCounts countValues(const GreyVolume& grey, int border, const MaskVolume* near, Progress& progress) {
    ValueCounts result;
    result.scale = grey.scale;
    result.offset = grey.offset;
    const Span z = spanOf(grey.frame.size.z, border);
    if (grey.empty() || z.last < z.first) return result;
    result.counts.assign(kNumbers, 0);
    const int layers = (z.last - z.first) / kBlock + 1;
    ProgressSteps steps(progress, layers, "counting values");
    std::mutex mutex;
    parallelFor(layers, [&](int layer) {
        if (progress.cancelled()) throw Cancelled();
        Counts counts(kNumbers);
        countLayer(grey, border, near, z.first + layer * kBlock, counts);
        {
            const std::lock_guard lock(mutex);
            std::transform(counts.begin(), counts.end(), result.counts.begin(), result.counts.begin(),
                           std::plus<>());
        }
        steps.done();
    });
    return result;
}

std::vector<float> barsOf(const ValueCounts& counts, double low, double high, int bars) {
    std::vector<float> heights(static_cast<std::size_t>(std::max(bars, 0)));
    if (counts.empty() || !(low < high) || !std::isfinite(high - low) || counts.scale == 0) return heights;
    // A stored number stands for what lies within half a step of it, so that no gaps are seen between them.
    const auto indexOf = [&](double value) {
        const double index = std::round((value - counts.offset) / counts.scale) - kLowestStored;
        return static_cast<std::ptrdiff_t>(std::clamp(index, -1.0, static_cast<double>(kNumbers)));
    };
    double most = 0;
    for (std::size_t n = 0; n < heights.size(); ++n) {
        const double share = (high - low) / static_cast<double>(heights.size());
        const double from = low + share * static_cast<double>(n);
        std::ptrdiff_t a = indexOf(from), b = indexOf(from + share);
        if (a > b) std::swap(a, b);
        b = std::max(b - 1, a);  // the next bar's
        std::uint64_t sum = 0;
        for (std::ptrdiff_t at = std::max<std::ptrdiff_t>(a, 0); at <= b && at < kNumbers; ++at)
            sum += counts.counts[static_cast<std::size_t>(at)];
        const double height = std::log1p(static_cast<double>(sum));
        heights[n] = static_cast<float>(height);
        most = std::max(most, height);
    }
    if (most > 0)
        for (float& height : heights) height = static_cast<float>(height / most);
    return heights;
}

}  // namespace stereonav
