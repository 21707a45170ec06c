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

ResampledRows::Box ResampledRows::boxOf(const PixelMap& map, int mapFirst, const SampleWindow& block) const {
    const SampleReader reader(nullptr, {}, mSource.width, mSource.height);
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    std::vector<Box> boxes(block.height, Box{glm::dvec2(kInfinite), glm::dvec2(-kInfinite)});
    parallelFor(block.height, [&](int k) {
        Box& box = boxes[k];
        for (int i = block.x; i < block.x + block.width; ++i) {
            const glm::dvec2 pixel = map.at(i, block.y + k - mapFirst);
            if (!reader.inside(pixel)) continue;
            box.low = {std::min(box.low.x, pixel.x), std::min(box.low.y, pixel.y)};
            box.high = {std::max(box.high.x, pixel.x), std::max(box.high.y, pixel.y)};
        }
    });
    Box all = boxes.front();
    for (const Box& box : boxes) {
        all.low = {std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y)};
        all.high = {std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y)};
    }
    return all;
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
