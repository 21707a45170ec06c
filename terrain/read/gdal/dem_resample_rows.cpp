// Blocks of a run of rows, each out of the window of the source that it lies in.
#include "terrain/read/gdal/dem_resample_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"
#include "engine/base/stop.h"
#include "terrain/read/gdal/sample_reader.h"

namespace stereonav {
namespace {

// Samples of the source at once: 64 MB. A block that needs more is parted.
constexpr long long kMostWindow = 1 << 24;

}  // namespace

ResampledRows::ResampledRows(const Georeference& source, const Georeference& target,
                             const std::filesystem::path& file, ReadWindow read)
    : mSource(source), mTarget(target), mMap(target, source, file), mRead(std::move(read)) {}

void ResampledRows::read(int first, int rows, float* heights) {
    const int mapFirst = first / PixelMap::kStep * PixelMap::kStep;
    const PixelMap map = mMap.map(mapFirst, first + rows - mapFirst);
    resample(map, mapFirst, {0, first, mTarget.width, rows}, heights);
}

// The map is bilinear between its nodes: the outermost places are those of the first and last samples between
// them.
ResampledRows::Box ResampledRows::boxOf(const PixelMap& map, int mapFirst, const SampleWindow& block) const {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    Box box{glm::dvec2(kInfinite), glm::dvec2(-kInfinite)};
    const int step = mMap.step(), right = block.x + block.width - 1, top = block.y - mapFirst,
              bottom = top + block.height - 1;
    // From the first sample between two nodes to the last, from there to the next node.
    const auto next = [&](int k, int last) {
        const int end = std::min(k | (step - 1), last);
        return k < end ? end : k + 1;
    };
    for (int j = top; j <= bottom; j = next(j, bottom))
        for (int i = block.x; i <= right; i = next(i, right)) {
            const glm::dvec2 pixel = map.at(i, j);
            if (!std::isfinite(pixel.x + pixel.y)) continue;  // one of the four nodes has no place
            box.low = {std::min(box.low.x, pixel.x), std::min(box.low.y, pixel.y)};
            box.high = {std::max(box.high.x, pixel.x), std::max(box.high.y, pixel.y)};
        }
    const bool apart =
        box.high.x < -1 || box.high.y < -1 || box.low.x > mSource.width + 1 || box.low.y > mSource.height + 1;
    return apart ? Box{glm::dvec2(kInfinite), glm::dvec2(-kInfinite)} : box;
}

// heights: where the block's first row and the target's first column lie.
void ResampledRows::resample(const PixelMap& map, int mapFirst, const SampleWindow& block, float* heights) {
    throwIfStopped();
    const Box box = boxOf(map, mapFirst, block);
    const SampleReader whole(nullptr, {}, mSource.width, mSource.height);
    const SampleWindow window = box.any() ? whole.around(box.low, box.high) : SampleWindow{};
    if (window.samples() > kMostWindow && block.samples() > 1) {
        SampleWindow a = block, b = block;
        if (block.width > block.height) {
            a.width /= 2, b.x += a.width, b.width -= a.width;
        } else {
            a.height /= 2, b.y += a.height, b.height -= a.height;
        }
        resample(map, mapFirst, a, heights);
        resample(map, mapFirst, b, heights + static_cast<std::size_t>(b.y - a.y) * mTarget.width);
        return;
    }
    mSamples.resize(static_cast<std::size_t>(window.samples()));
    if (box.any()) mRead(window, mSamples.data());
    const SampleReader reader(mSamples.data(), window, mSource.width, mSource.height);
    parallelFor(block.height, [&](int k) {
        float* out = heights + static_cast<std::size_t>(k) * mTarget.width;
        for (int i = block.x; i < block.x + block.width; ++i) {
            const glm::dvec2 pixel = map.at(i, block.y + k - mapFirst);
            out[i] = reader.inside(pixel) ? reader.between(pixel) : std::numeric_limits<float>::quiet_NaN();
        }
    });
}

}  // namespace stereonav
