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
    mBands[band] = {band, static_cast<int>(out - list)};
}

long long HoleFill::fill(const EyeRenderer& renderer, const EyeView& view, const Plane<std::uint8_t>& mask,
                         Schedule schedule, EyeImage& image) {
    const int bands = (mask.width() + kBandWidth - 1) / kBandWidth;
    const std::size_t capacity = static_cast<std::size_t>(kBandWidth) * mask.height();
    mPixels.resize(capacity * bands);
    mBands.resize(bands);
    forEachPiece(bands, Schedule::Dynamic, [&](int, int band) { listBand(mask, band); });
    if (schedule == Schedule::Dynamic)
        std::sort(mBands.begin(), mBands.end(), [](const Band& a, const Band& b) {
            return a.holes != b.holes ? a.holes > b.holes : a.index < b.index;
        });
    forEachPiece(bands, schedule, [&](int, int i) {
        const Band& band = mBands[i];
        if (band.holes == 0) return;
        const int x0 = band.index * kBandWidth;
        const PixelRect bounds{x0, 0, std::min(x0 + kBandWidth, mask.width()), mask.height()};
        const PixelIndex* list = mPixels.data() + capacity * band.index;
        renderer.renderPixels(view, bounds, std::span(list, static_cast<std::size_t>(band.holes)), image);
    });
    return std::accumulate(mBands.begin(), mBands.end(), 0ll,
                           [](long long sum, const Band& b) { return sum + b.holes; });
}

}  // namespace stereonav
