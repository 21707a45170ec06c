// Lists the holes of each band top row first, then casts the bands.
#include "engine/stereo/hole_fill.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

namespace stereonav {

namespace {

constexpr int kWords = HoleFill::kBandWidth / 8;

// One bit for each of eight mask bytes (0 or 255), the first in bit 0: the product moves the lowest bit of
// byte k to bit 56 + k.
std::uint32_t bitsOf(std::uint64_t bytes) {
    return static_cast<std::uint32_t>((bytes & 0x0101010101010101u) * 0x0102040810204080u >> 56);
}

// Bits of the holes among a band's pixels in one row. Rows are padded, so that all words can be read.
std::uint32_t holesOfRow(const std::uint8_t* mask) {
    std::uint64_t words[kWords];
    std::memcpy(words, mask, sizeof words);
    if ((words[0] | words[1] | words[2] | words[3]) == 0) return 0;
    std::uint32_t bits = 0;
    for (int k = 0; k < kWords; ++k) bits |= bitsOf(words[k]) << 8 * k;
    return bits;
}

}  // namespace

void HoleFill::listBand(const Plane<std::uint8_t>& mask, int band) {
    static_assert(kWords == 4 && kBandWidth == 32, "a row of a band is a word of bits");
    static_assert(Plane<std::uint8_t>::kPadding >= 16, "strides reach to the end of the last band");
    const std::size_t capacity = static_cast<std::size_t>(kBandWidth) * mask.height();
    PixelIndex* const list = mPixels.data() + capacity * band;
    PixelIndex* out = list;
    const int x0 = band * kBandWidth;
    const int inside = mask.width() - x0;
    const std::uint32_t wanted = inside >= kBandWidth ? ~0u : (1u << inside) - 1u;
    for (int y = 0; y < mask.height(); ++y)
        for (std::uint32_t bits = holesOfRow(mask.row(y) + x0) & wanted; bits != 0; bits &= bits - 1)
            *out++ = {static_cast<std::uint16_t>(x0 + std::countr_zero(bits)), static_cast<std::uint16_t>(y)};
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

long long HoleFill::list(const Plane<std::uint8_t>& mask, Schedule schedule) {
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
    return std::accumulate(mHoles.begin(), mHoles.end(), 0ll);
}

void HoleFill::cast(const EyeRenderer& renderer, const EyeView& view, Schedule schedule,
                    EyeImage& image) const {
    forEach(schedule, [&](PixelRect bounds, std::span<const PixelIndex> pixels) {
        renderer.renderPixels(view, bounds, pixels, image);
    });
}

}  // namespace stereonav
