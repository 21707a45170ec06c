#include "engine/metrics/rivalry.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/metrics/mean_square.h"
#include "engine/metrics/srgb_levels.h"

namespace stereonav {
namespace {

constexpr double kSameParallax = 1.0;  // pixels; as edgeMask tells depths apart

template <typename A, typename B>
void checkSize(const Plane<A>& wanted, const Plane<B>& plane, const char* what) {
    if (!plane.empty() && plane.width() == wanted.width() && plane.height() == wanted.height()) return;
    throw Error("", what,
                fmt::format("expected {}x{} pixels, got {}x{}", wanted.width(), wanted.height(),
                            plane.width(), plane.height()),
                "give planes of one size");
}

// The two pixels that a column lies between.
struct Between {
    int low, high;
    float share;  // share of the high one

    explicit Between(float column)
        : low(static_cast<int>(column)), high(low), share(column - static_cast<float>(low)) {
        if (share > 0) ++high;
    }
};

glm::vec3 levelsAt(const PackedColor* row, const Between& place) {
    return glm::mix(srgbLevels(row[place.low]), srgbLevels(row[place.high]), place.share);
}

}  // namespace

Plane<float> columnsInRightEye(const StereoViews& views, const Plane<float>& leftDepth,
                               const Plane<float>& rightDepth) {
    checkSize(leftDepth, rightDepth, "the right eye's depths");
    Plane<float> columns(leftDepth.width(), leftDepth.height());
    parallelFor(leftDepth.height(), [&](int y) {
        const auto parallax = [&](float depth) { return views.parallaxScale / depth; };
        const float* const depths = rightDepth.row(y);
        for (int x = 0; x < leftDepth.width(); ++x) {
            const float depth = leftDepth.at(x, y);
            float& column = columns.at(x, y);
            column = -1;
            if (!(depth > 0)) continue;  // nothing known
            const double place = views.rightColumn(x + 0.5, depth) - 0.5;
            if (!(place >= 0 && place <= leftDepth.width() - 1)) continue;
            const Between pixels(static_cast<float>(place));
            const auto shows = [&](int at) {
                return depths[at] > 0 && std::abs(parallax(depths[at]) - parallax(depth)) <= kSameParallax;
            };
            if (shows(pixels.low) && shows(pixels.high)) column = static_cast<float>(place);
        }
    });
    return columns;
}

Rivalry rivalryOf(const Plane<float>& columns, const TwoEyes& truth, const TwoEyes& image,
                  const Plane<std::uint8_t>& rightMask) {
    for (const Plane<PackedColor>* const plane : {&truth.left, &truth.right, &image.left, &image.right})
        checkSize(columns, *plane, "the eyes' pictures");
    checkSize(columns, rightMask, "the mask");
    const auto height = static_cast<std::size_t>(columns.height());
    std::vector<MeanSquare> all(height), edges(height);
    parallelFor(columns.height(), [&](int y) {
        const auto row = static_cast<std::size_t>(y);
        const auto apart = [&](const TwoEyes& eyes, int x, const Between& place) {
            return levelsAt(eyes.right.row(y), place) - srgbLevels(eyes.left.at(x, y));
        };
        for (int x = 0; x < columns.width(); ++x) {
            if (columns.at(x, y) < 0) continue;
            const Between place(columns.at(x, y));
            const glm::vec3 off = apart(image, x, place) - apart(truth, x, place);
            all[row].add(off);
            if (rightMask.at(place.low, y) != 0 || rightMask.at(place.high, y) != 0) edges[row].add(off);
        }
    });
    const MeanSquare sum = sumOf(all);
    return {
        sum.psnr_db(), sumOf(edges).psnr_db(),
        100.0 * static_cast<double>(sum.pixels) / (static_cast<double>(columns.width()) * columns.height())};
}

}  // namespace stereonav
