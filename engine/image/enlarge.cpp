#include "engine/image/enlarge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Where a pixel's centre lies among `from` others: the two beside it, the weight of the second in 256ths, and
// the nearest.
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

PackedColor between(const PackedColor* above, const PackedColor* below, const Place& x, std::uint32_t y) {
    PackedColor mixed = 0;
    for (const int shift : {0, 10, 20}) {
        const auto channel = [shift](PackedColor c) { return c >> shift & 1023u; };
        const std::uint32_t top =
            channel(above[x.first]) * (256 - x.weight) + channel(above[x.second]) * x.weight;
        const std::uint32_t bottom =
            channel(below[x.first]) * (256 - x.weight) + channel(below[x.second]) * x.weight;
        mixed |= (top * (256 - y) + bottom * y + 32768u) >> 16 << shift;
    }
    return mixed;
}

}  // namespace

EyeImage enlarged(const EyeImage& image, int width, int height) {
    EyeImage large;
    large.resize(width, height);
    const std::vector<Place> columns = placesOf(image.width(), width),
                             rows = placesOf(image.height(), height);
    parallelFor(height, [&](int y) {
        const Place& row = rows[static_cast<std::size_t>(y)];
        const PackedColor *above = image.color.row(row.first), *below = image.color.row(row.second);
        const float* depth = image.viewDepth.row(row.nearest);
        for (int x = 0; x < width; ++x) {
            const Place& column = columns[static_cast<std::size_t>(x)];
            large.color.at(x, y) = between(above, below, column, row.weight);
            large.viewDepth.at(x, y) = depth[column.nearest];
        }
    });
    return large;
}

}  // namespace stereonav
