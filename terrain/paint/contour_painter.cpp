#include "terrain/paint/contour_painter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/math/nice_step.h"
#include "terrain/paint/contour_rows.h"
#include "terrain/paint/ground_view.h"

namespace stereonav {
namespace {

constexpr double kReliefParts = 5;
constexpr double kMostLevels = 1e9;  // from zero: beyond, heights have no digits for lines between

// Returns the share of a pixel that a line covers. width: of the line; distance: of the pixel's centre from
// the line's middle; pixels.
double coverOfLine(double width, double distance) {
    return std::clamp(0.5 * width + 0.5 - distance, 0.0, std::min(1.0, width));
}

double fadeOfLines(double pixelsBetween) {
    const double share =
        std::clamp((pixelsBetween - kContourGone) / (kContourWhole - kContourGone), 0.0, 1.0);
    return share * share * (3 - 2 * share);
}

// height: within kMostLevels steps. (Rounding by a conversion: the library's is a call.)
double distanceFrom(double height, double step) {
    const double steps = height / step;
    return std::abs(height -
                    step * static_cast<double>(static_cast<long long>(steps + (steps < 0 ? -0.5 : 0.5))));
}

// Differences of height between a pixel and its two neighbours along one axis: the larger and the smaller.
// NaN where neither neighbour shows ground.
struct HeightSteps {
    double more, less;
};
HeightSteps stepsOf(double height, double before, double after) {
    const double a = std::abs(before - height), b = std::abs(after - height);
    // A number counts beside a NaN.
    return {!(a <= b) && a == a ? a : b, !(a >= b) && a == a ? a : b};
}

// The heights of what one row of an eye shows and of the rows beside it; NaN where it shows nothing.
class HeightRows {
public:
    HeightRows(const EyeView& view, const EyeImage& image, int y) : mWidth(image.width()) {
        mHeights.assign(3 * static_cast<std::size_t>(mWidth + 2), std::nan(""));
        for (int k = 0; k < 3; ++k) {
            const int row = y + k - 1;
            if (row < 0 || row >= image.height()) continue;
            const double first = view.rayDirection(0.5, row + 0.5).z, step = view.right.z * view.pixelWidth();
            const float* const depth = image.viewDepth.row(row);
            double* const heights = at(k);
            const EarthBend bend = view.bend();
            for (int x = 0; x < mWidth; ++x) {
                double height = view.eye.z + static_cast<double>(depth[x]) * (first + step * x);
                if (bend.fall > 0)
                    height += bend.sinkAt(
                        glm::dvec2(view.pointAt(x + 0.5, row + 0.5, static_cast<double>(depth[x]))));
                heights[x] = depth[x] > 0 && depth[x] < kMissDepth ? height : std::nan("");
            }
        }
    }
    double height(int x) const { return at(1)[x]; }
    HeightSteps across(int x) const { return stepsOf(height(x), at(1)[x - 1], at(1)[x + 1]); }
    HeightSteps down(int x) const { return stepsOf(height(x), at(0)[x], at(2)[x]); }

private:
    // One more at both ends, which show nothing.
    double* at(int k) { return mHeights.data() + static_cast<std::size_t>(k) * (mWidth + 2) + 1; }
    const double* at(int k) const { return mHeights.data() + static_cast<std::size_t>(k) * (mWidth + 2) + 1; }

    int mWidth;
    std::vector<double> mHeights;
};

class LinesOfRow {
public:
    LinesOfRow(const HeightRows& heights, const ContourSetting& setting)
        : mHeights(heights),
          mSetting(setting),
          mInterval(setting.interval),
          mPerMetre(1 / setting.verticalScale) {}

    // Returns whether there can be a line in a pixel: most are told by the depths alone. A line's reach, and
    // a pixel more, as a warped eye's depths may be those of the next one.
    bool mayHaveLine(int x) const {
        const double height = mHeights.height(x) * mPerMetre;
        if (!(std::abs(height) < kMostLevels * mInterval)) return false;
        const HeightSteps across = mHeights.across(x), down = mHeights.down(x);
        if (kIndexContour * mInterval <= kContourGone * leastChange(across, down)) return false;
        const double most = mPerMetre * (across.more + down.more);
        return !(distanceFrom(height, mInterval) > kContourReach * most);
    }

    // The ink's share; 0 where there is no line.
    double at(int x, const GroundSeen& seen) const {
        return contourShareAt(seen, leastChange(mHeights.across(x), mHeights.down(x)), mSetting);
    }

private:
    // Half of how much heights differ from pixel to pixel, by the lesser of both sides, as a silhouette at
    // one of them means nothing. Where ground is rougher than pixels are, its tangent planes do not tell.
    // Half, as a warped eye's depths may be those of the next pixel. 0 where nothing is known.
    double leastChange(const HeightSteps& across, const HeightSteps& down) const {
        // A number counts beside a NaN.
        const double least = across.less >= down.less || down.less != down.less ? across.less : down.less;
        return least > 0 ? 0.5 * mPerMetre * least : 0;
    }

    const HeightRows& mHeights;
    const ContourSetting& mSetting;
    double mInterval, mPerMetre;
};

}  // namespace

double contourShareAt(const GroundSeen& seen, double least, const ContourSetting& setting) {
    const double interval = setting.interval, perMetre = 1 / setting.verticalScale;
    const double height = seen.place.z * perMetre, index = kIndexContour * interval;
    // A pixel's; of level ground none but rounding.
    const double i = glm::dot(seen.gradient, glm::dvec2(seen.perX)),
                 j = glm::dot(seen.gradient, glm::dvec2(seen.perY));
    double change = perMetre * std::sqrt(i * i + j * j);
    if (!(change > kContourLevel * interval) || !(std::abs(height) < kMostLevels * interval)) return 0;
    const double wide = kIndexContourShare *
                        coverOfLine(kIndexContourWidth, distanceFrom(height, index) / change),
                 thin = kContourShare * coverOfLine(kContourWidth, distanceFrom(height, interval) / change);
    if (wide <= 0 && thin <= 0) return 0;
    change = std::max(change, least);
    return std::max(wide * fadeOfLines(index / change), thin * fadeOfLines(interval / change));
}

double contourIntervalFor(double relief) {
    return relief > 0 && std::isfinite(relief) ? niceStep(relief / kReliefParts) : 0;
}

void ContourPainter::paint(const EyeView& view, EyeImage& image) const {
    if (!(mSetting.interval > 0) || image.viewDepth.empty()) return;
    const ContourRows rows(mGround, mFog, mSetting, view, mTarget);
    if (!rows.fits()) {
        paintPlainly(view, image);
        return;
    }
    parallelFor(image.height(), [&](int y) { rows.paint(image, y); });
}

void ContourPainter::paintPlainly(const EyeView& view, EyeImage& image) const {
    if (!(mSetting.interval > 0) || image.viewDepth.empty()) return;
    const GroundView ground(mGround, view);
    parallelFor(image.height(), [&](int y) {
        const HeightRows heights(view, image, y);
        const LinesOfRow lines(heights, mSetting);
        for (int x = 0; x < image.width(); ++x) {
            if (!lines.mayHaveLine(x)) continue;
            GroundSeen seen;
            if (!ground.at(x, y, image.viewDepth.at(x, y), seen)) continue;
            const double share = lines.at(x, seen);
            if (share <= 0) continue;
            const glm::vec3 ink = mFog.seen(glm::vec3(kContourInk[0], kContourInk[1], kContourInk[2]),
                                            view.eye, seen.direction, seen.depth);
            PackedColor& color = image.color.at(x, y);
            color = packColor(glm::mix(unpackColor(color), ink, static_cast<float>(share)));
        }
    });
}

}  // namespace stereonav
