#include "terrain/paint/contour_painter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "engine/math/nice_step.h"
#include "terrain/paint/ground_view.h"

namespace stereonav {
namespace {

constexpr double kReliefParts = 5;
constexpr double kLevel = 1e-7;      // of an interval, a pixel
constexpr double kMostLevels = 1e9;  // from zero: beyond, heights have no digits for lines between

// Of a line `width` pixels wide, in a pixel whose centre is so many from its middle.
double coverOfLine(double width, double distance) {
    return std::clamp(0.5 * width + 0.5 - distance, 0.0, std::min(1.0, width));
}

double fadeOfLines(double pixelsBetween) {
    const double share =
        std::clamp((pixelsBetween - kContourGone) / (kContourWhole - kContourGone), 0.0, 1.0);
    return share * share * (3 - 2 * share);
}

double distanceFrom(double height, double step) {
    return std::abs(height - step * std::round(height / step));
}

// Half of how much heights differ between a pixel and those beside it, one way: the lesser of both sides, as
// a silhouette at one of them means nothing. Where ground is rougher than pixels are, its tangent planes do
// not tell. Half, as a warped eye's depths may be those of the next pixel.
double halfStep(double height, double before, double after) {
    double step = std::fmin(std::abs(before - height), std::abs(after - height));
    return std::isfinite(step) ? 0.5 * step : 0;
}

class ContourRow {
public:
    ContourRow(const GroundView& ground, const EyeImage& image, const ContourSetting& setting)
        : mGround(ground), mImage(image), mSetting(setting) {}

    // The ink's share; 0 where there is no line.
    double at(int x, int y, const GroundSeen& seen) const {
        const double perMetre = 1 / mSetting.verticalScale, height = seen.place.z * perMetre;
        const double interval = mSetting.interval, index = kIndexContour * interval;
        // A pixel's; of level ground none but rounding.
        double change = perMetre * std::hypot(glm::dot(seen.gradient, glm::dvec2(seen.perX)),
                                              glm::dot(seen.gradient, glm::dvec2(seen.perY)));
        if (!(change > kLevel * interval) || !(std::abs(height) < kMostLevels * interval)) return 0;
        const double fromIndex = distanceFrom(height, index) / change,
                     from = distanceFrom(height, interval) / change;
        const double wide = kIndexContourShare * coverOfLine(kIndexContourWidth, fromIndex),
                     thin = kContourShare * coverOfLine(kContourWidth, from);
        if (wide <= 0 && thin <= 0) return 0;
        change = std::max(change, stepBeside(x, y, seen.place.z) * perMetre);
        return std::max(wide * fadeOfLines(index / change), thin * fadeOfLines(interval / change));
    }

private:
    double stepBeside(int x, int y, double height) const {
        const auto of = [&](int i, int j) {
            if (i < 0 || j < 0 || i >= mImage.width() || j >= mImage.height()) return std::nan("");
            return mGround.heightOf(i, j, mImage.viewDepth.at(i, j));
        };
        return std::max(halfStep(height, of(x - 1, y), of(x + 1, y)),
                        halfStep(height, of(x, y - 1), of(x, y + 1)));
    }

    const GroundView& mGround;
    const EyeImage& mImage;
    const ContourSetting& mSetting;
};

}  // namespace

double contourIntervalFor(double relief) {
    return relief > 0 && std::isfinite(relief) ? niceStep(relief / kReliefParts) : 0;
}

void ContourPainter::paint(const EyeView& view, EyeImage& image) const {
    if (!(mSetting.interval > 0) || image.viewDepth.empty()) return;
    const GroundView ground(mGround, view);
    const ContourRow lines(ground, image, mSetting);
    parallelFor(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x) {
            GroundSeen seen;
            if (!ground.at(x, y, image.viewDepth.at(x, y), seen)) continue;
            const double share = lines.at(x, y, seen);
            if (share <= 0) continue;
            const glm::vec3 ink = mFog.seen(glm::vec3(kContourInk[0], kContourInk[1], kContourInk[2]),
                                            view.eye, seen.direction, seen.depth);
            PackedColor& color = image.color.at(x, y);
            color = packColor(glm::mix(unpackColor(color), ink, static_cast<float>(share)));
        }
    });
}

}  // namespace stereonav
