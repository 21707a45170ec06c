// Lists the holes of each band top row first, then casts the bands.
#include "engine/stereo/hole_fill.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>

#include "engine/stereo/work_queue.h"

namespace stereonav {

void HoleFill::listBand(const Plane<std::uint8_t>& mask, int band) {
    static_assert(kBandWidth % 8 == 0);
    const std::size_t capacity = static_cast<std::size_t>(kBandWidth) * mask.height();
    PixelIndex* const list = mPixels.data() + capacity * band;
    PixelIndex* out = list;
    const int x0 = band * kBandWidth;
    const int x1 = std::min(x0 + kBandWidth, mask.width());
    for (int y = 0; y < mask.height(); ++y) {
        const std::uint8_t* row = mask.row(y);
        for (int x = x0; x < x1; x += 8) {
            std::uint64_t eight;  // rows are padded, so eight can be read
            std::memcpy(&eight, row + x, sizeof eight);
            if (eight == 0) continue;
            for (int i = x; i < std::min(x + 8, x1); ++i)
                if (row[i]) *out++ = {static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(y)};
        }
    }
    mHoles[band] = static_cast<int>(out - list);
}

// Appends the band's tasks: itself, or its pieces.
void HoleFill::cutBand(const Plane<std::uint8_t>& mask, int band) {
    const PixelIndex* next = mPixels.data() + static_cast<std::size_t>(kBandWidth) * mask.height() * band;
    const PixelIndex* const end = next + mHoles[band];
    const int rows = mHoles[band] > kTaskHoles ? kTaskRows : mask.height();
    const int x0 = band * kBandWidth, x1 = std::min(x0 + kBandWidth, mask.width());
    for (int y0 = 0; next != end; y0 += rows) {
        const int y1 = std::min(y0 + rows, mask.height());
        const PixelIndex* const first = next;
        next = std::find_if(first, end, [&](PixelIndex p) { return p.y >= y1; });
        if (next != first) mTasks.push_back({{x0, y0, x1, y1}, first, static_cast<int>(next - first)});
    }
}

long long HoleFill::fill(const EyeRenderer& renderer, const EyeView& view, const Plane<std::uint8_t>& mask,
                         Schedule schedule, EyeImage& image) {
    const int bands = (mask.width() + kBandWidth - 1) / kBandWidth;
    const std::size_t capacity = static_cast<std::size_t>(kBandWidth) * mask.height();
    mPixels.resize(capacity * bands);
    mHoles.resize(bands);
    forEachPiece(bands, Schedule::Dynamic, [&](int, int band) { listBand(mask, band); });
    mTasks.clear();
    for (int band = 0; band < bands; ++band) cutBand(mask, band);
    if (schedule == Schedule::Dynamic)
        std::stable_sort(mTasks.begin(), mTasks.end(),
                         [](const Task& a, const Task& b) { return a.holes > b.holes; });
    forEachPiece(static_cast<int>(mTasks.size()), schedule, [&](int, int i) {
        const Task& task = mTasks[i];
        renderer.renderPixels(view, task.bounds, std::span(task.pixels, static_cast<std::size_t>(task.holes)),
                              image);
    });
    return std::accumulate(mHoles.begin(), mHoles.end(), 0ll);
}

}  // namespace stereonav
