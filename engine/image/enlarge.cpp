#include "engine/image/enlarge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Position of a pixel's centre among `from` source pixels: the two pixels beside it, the weight of the second
// in 256ths, and the nearest one.
struct Place {
    int first = 0, second = 0, nearest = 0;
    std::uint32_t weight = 0;
};

std::vector<Place> placesOf(int from, int to) {
    std::vector<Place> places(static_cast<std::size_t>(to));
    for (int n = 0; n < to; ++n) {
        const double at = (n + 0.5) * from / to - 0.5, low = std::floor(at);
        Place& place = places[static_cast<std::size_t>(n)];
        place.first = std::clamp(static_cast<int>(low), 0, from - 1);
        place.second = std::clamp(static_cast<int>(low) + 1, 0, from - 1);
        place.nearest = std::clamp(static_cast<int>(std::floor(at + 0.5)), 0, from - 1);
        place.weight = static_cast<std::uint32_t>(std::lround(256 * (at - low)));
    }
    return places;
}

// A colour between two rows, times 256: red and green in the halves of one number, so that both are mixed by
// one product. Times 256 again they still have room: 1023 * 65536 < 2^32.
struct Mixed {
    std::uint64_t redGreen;
    std::uint32_t blue;
};

std::uint64_t redGreenOf(PackedColor c) {
    return (c & 1023u) | static_cast<std::uint64_t>(c >> 10 & 1023u) << 32;
}

Mixed between(PackedColor above, PackedColor below, std::uint32_t weight) {
    return {redGreenOf(above) * (256 - weight) + redGreenOf(below) * weight,
            (above >> 20 & 1023u) * (256 - weight) + (below >> 20 & 1023u) * weight};
}

PackedColor between(const Mixed& left, const Mixed& right, std::uint32_t weight) {
    constexpr std::uint64_t kHalf = 32768;
    const std::uint64_t redGreen =
        left.redGreen * (256 - weight) + right.redGreen * weight + (kHalf | kHalf << 32);
    const std::uint32_t blue = left.blue * (256 - weight) + right.blue * weight + 32768u;
    return static_cast<PackedColor>(redGreen >> 16 & 1023u) | static_cast<PackedColor>(redGreen >> 48) << 10 |
           blue >> 16 << 20;
}

}  // namespace

void enlarge(const EyeImage& image, int width, int height, EyeImage& large) {
    large.resize(width, height);
    const std::vector<Place> columns = placesOf(image.width(), width),
                             rows = placesOf(image.height(), height);
    parallelFor(height, [&](int y) {
        const Place& row = rows[static_cast<std::size_t>(y)];
        const PackedColor *above = image.color.row(row.first), *below = image.color.row(row.second);
        const float* depth = image.viewDepth.row(row.nearest);
        thread_local std::vector<Mixed> mixed;
        mixed.clear();
        for (int x = 0; x < image.width(); ++x) mixed.push_back(between(above[x], below[x], row.weight));
        PackedColor* const largeColor = large.color.row(y);
        float* const largeDepth = large.viewDepth.row(y);
        const Mixed* const from = mixed.data();
        for (int x = 0; x < width; ++x) {
            const Place column = columns[static_cast<std::size_t>(x)];
            largeColor[x] = between(from[column.first], from[column.second], column.weight);
            largeDepth[x] = depth[column.nearest];
        }
    });
}

}  // namespace stereonav
