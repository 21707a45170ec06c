#include "app/view/transfer_curve.h"

#include <algorithm>
#include <cmath>

#include "engine/image/packed_color.h"
#include "engine/volume/transfer_text.h"

namespace stereonav {
namespace {

constexpr double kLargest = 1e30;  // largest value, within the range of floats
constexpr double kMargin = 0.02;   // share of a view, at both ends
constexpr double kFar = 1;         // multiple of the values' range: points farther outside are out of view
constexpr double kSteps = 1000;    // steps across a view
constexpr double kRampOpacity = 0.5, kMillimetre = 0.001;
constexpr double kFinest = 1e-9;  // least size of a view, as a share of the values' size

// Returns the least distance of two neighbours.
double gapBeside(double value) {
    return std::max(std::abs(value) * 1e-9, 1e-9);
}

double share(double x) {
    return std::clamp(x, 0.0, 1.0);
}

}  // namespace

TransferCurve::TransferCurve(const TransferFunction& function)
    : mReferenceLength(function.referenceLength()) {
    if (function.points().size() > kMostCurvePoints) return;
    for (const TransferPoint& point : function.points()) {
        CurvePoint& p = mPoints.emplace_back();
        p.value = point.value;
        p.opacity = point.opacity;
        for (int c = 0; c < 3; ++c)
            p.color[static_cast<std::size_t>(c)] = std::clamp(srgbFromLinear(point.color[c]), 0.0f, 1.0f);
    }
}

bool TransferCurve::full() const {
    return mPoints.size() >= kMostCurvePoints;
}

TransferFunction TransferCurve::function() const {
    std::vector<TransferPoint> points;
    for (const CurvePoint& p : mPoints) {
        TransferPoint& point = points.emplace_back();
        point.value = p.value;
        point.opacity = p.opacity;
        for (int c = 0; c < 3; ++c)
            point.color[c] = std::min(linearFromSrgb(p.color[static_cast<std::size_t>(c)]), 1.0f);
    }
    return {std::move(points), mReferenceLength, "curve"};
}

std::string TransferCurve::text() const {
    return curveTextOf(function());
}

CurvePoint TransferCurve::at(double value) const {
    const TransferPoint point = function().at(value);
    CurvePoint p;
    p.value = value;
    p.opacity = point.opacity;
    for (int c = 0; c < 3; ++c)
        p.color[static_cast<std::size_t>(c)] = std::clamp(srgbFromLinear(point.color[c]), 0.0f, 1.0f);
    return p;
}

std::size_t TransferCurve::insert(double value, double opacity) {
    if (!std::isfinite(value) || std::isnan(opacity) || mPoints.empty()) return kNone;
    value = std::clamp(value, -kLargest, kLargest);
    const auto above = std::lower_bound(mPoints.begin(), mPoints.end(), value,
                                        [](const CurvePoint& p, double v) { return p.value < v; });
    const std::size_t index = static_cast<std::size_t>(above - mPoints.begin());
    // A point too close to a neighbour becomes that neighbour.
    for (const std::size_t beside : {index, index - 1}) {
        if (beside >= mPoints.size() || std::abs(mPoints[beside].value - value) > gapBeside(value)) continue;
        mPoints[beside].opacity = share(opacity);
        return beside;
    }
    if (full()) return kNone;
    CurvePoint point = at(value);
    point.opacity = share(opacity);
    mPoints.insert(above, point);
    return index;
}

void TransferCurve::move(std::size_t index, double value, double opacity) {
    if (index >= mPoints.size()) return;
    CurvePoint& point = mPoints[index];
    if (!std::isnan(opacity)) point.opacity = share(opacity);
    if (std::isnan(value)) return;
    double low = -kLargest, high = kLargest;
    if (index > 0) low = mPoints[index - 1].value + gapBeside(mPoints[index - 1].value);
    if (index + 1 < mPoints.size()) high = mPoints[index + 1].value - gapBeside(mPoints[index + 1].value);
    if (low <= high) point.value = std::clamp(value, low, high);
}

void TransferCurve::recolor(std::size_t index, const std::array<float, 3>& color) {
    if (index >= mPoints.size()) return;
    for (std::size_t c = 0; c < 3; ++c)
        if (!std::isnan(color[c])) mPoints[index].color[c] = std::clamp(color[c], 0.0f, 1.0f);
}

bool TransferCurve::remove(std::size_t index) {
    if (index >= mPoints.size() || mPoints.size() == 1) return false;
    mPoints.erase(mPoints.begin() + static_cast<std::ptrdiff_t>(index));
    return true;
}

TransferCurve rampBetween(double low, double high) {
    if (!(low < high) || !std::isfinite(low) || !std::isfinite(high))
        return TransferCurve(TransferFunction());
    const glm::vec3 dark(0.5f, 0.25f, 0.2f), bright(1.0f);
    return TransferCurve(
        TransferFunction({{low, dark, 0}, {high, bright, kRampOpacity}}, kMillimetre, "ramp"));
}

double ValueView::shareOf(double value) const {
    // Halves are used, since the difference of two finite numbers may be infinite.
    const double at = (value / 2 - low / 2) / (high / 2 - low / 2);
    return std::isnan(at) ? 0 : std::clamp(at, -1e6, 1e6);
}

double ValueView::valueAt(double share) const {
    return low * (1 - share) + high * share;
}

double ValueView::step() const {
    const double wanted = (high / 2 - low / 2) / (kSteps / 2);
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double digit : {5.0, 2.0})
        if (digit * decade <= wanted) return digit * decade;
    return decade;
}

double ValueView::rounded(double value) const {
    const double by = step();
    if (!(by > 0) || !std::isfinite(by)) return value;
    // Quotients of whole numbers for steps below 1 give short texts.
    return by < 1 ? std::round(value * std::round(1 / by)) / std::round(1 / by) : std::round(value / by) * by;
}

ValueView viewOf(double lowest, double highest, const TransferCurve& curve) {
    if (!std::isfinite(lowest)) lowest = 0;
    if (!std::isfinite(highest)) highest = lowest;
    lowest = std::clamp(lowest, -kLargest, kLargest);
    highest = std::clamp(highest, lowest, kLargest);
    ValueView view{lowest, highest};
    const double far = kFar * std::max(highest - lowest, gapBeside(lowest));
    for (const CurvePoint& point : curve.points()) {
        // A single value has no range: then all points are shown.
        if (highest > lowest && (point.value < lowest - far || point.value > highest + far)) continue;
        view.low = std::min(view.low, point.value);
        view.high = std::max(view.high, point.value);
    }
    const double size = std::max({std::abs(view.low), std::abs(view.high), 1.0});
    const double margin = std::max(kMargin * (view.high - view.low), 1e-6 * size);
    view.low -= margin;
    view.high += margin;
    return view;
}

ValueView zoomed(const ValueView& view, double factor, double about, const ValueView& all) {
    if (!(factor > 0) || !std::isfinite(factor) || !std::isfinite(about)) return view;
    const double share = std::clamp(view.shareOf(about), 0.0, 1.0), place = view.valueAt(share);
    const double size = std::max({std::abs(all.low), std::abs(all.high), 1e-300});
    const double width = std::clamp((view.high - view.low) * factor, kFinest * size, all.high - all.low);
    ValueView next{place - share * width, place + (1 - share) * width};
    if (next.low < all.low) next = {all.low, all.low + width};
    if (next.high > all.high) next = {std::max(all.high - width, all.low), all.high};
    return next.low < next.high ? next : view;
}

}  // namespace stereonav
