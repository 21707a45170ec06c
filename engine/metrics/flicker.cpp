#include "engine/metrics/flicker.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/metrics/mean_square.h"
#include "engine/metrics/srgb_levels.h"

namespace stereonav {

double flickerPsnr(const Moments& truth, const Moments& image) {
    const int width = truth.now.width(), height = truth.now.height();
    for (const Plane<PackedColor>* const plane : {&truth.now, &truth.before, &image.now, &image.before})
        if (plane->empty() || plane->width() != width || plane->height() != height)
            throw Error("", "the pictures of two moments",
                        fmt::format("expected four of {}x{} pixels, got one of {}x{}", width, height,
                                    plane->width(), plane->height()),
                        "render all at the same size");
    std::vector<MeanSquare> rows(static_cast<std::size_t>(height));
    parallelFor(height, [&](int y) {
        const auto change = [y](const Moments& m, int x) {
            return srgbLevels(m.now.at(x, y)) - srgbLevels(m.before.at(x, y));
        };
        for (int x = 0; x < width; ++x)
            rows[static_cast<std::size_t>(y)].add(change(image, x) - change(truth, x));
    });
    return sumOf(rows).psnr_db();
}

}  // namespace stereonav
