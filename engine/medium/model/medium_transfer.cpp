// Evaluates a transfer function at a value and a gradient magnitude: points or regions turned into
// extinctions once per question; renderers ask its table (medium_table.cpp) instead.
#include "engine/medium/model/medium_transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <limits>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "engine/medium/model/medium_check.h"

namespace stereonav {
namespace {

constexpr double kShortest = 1e-12, kLongest = 1e12;  // metres of reference: extinctions stay normal floats
constexpr float kLeastTransport = static_cast<float>(1.0 - MediumTransfer::kDensest);

constexpr const char* kAdvice = "see \"Media\" in docs/formats.md for what a medium's numbers mean";

bool isShare(double x) {
    return x >= 0 && x <= 1;  // false for NaN
}

std::string problemOfColor(const char* name, const glm::vec3& color) {
    for (int c = 0; c < 3; ++c)
        if (!isShare(color[c])) return fmt::format("expected a {} in 0 to 1, got {}", name, color[c]);
    return "";
}

std::string problemOf(const MediumMaterial& m) {
    if (std::string problem = problemOfColor("colour", m.color); !problem.empty()) return problem;
    if (!isShare(m.opacity)) return fmt::format("expected an opacity in 0 to 1, got {}", m.opacity);
    if (std::string problem = problemOfColor("transport colour", m.transport); !problem.empty())
        return problem;
    if (!isShare(m.surface)) return fmt::format("expected a surface weight in 0 to 1, got {}", m.surface);
    for (int c = 0; c < 3; ++c)
        if (!(m.glow[c] >= 0 && std::isfinite(m.glow[c])))
            return fmt::format("expected a glow of 0 or more, got {}", m.glow[c]);
    return "";
}

std::string fourNumbers(const double (&t)[4]) {
    return fmt::format("{} {} {} {}", t[0], t[1], t[2], t[3]);
}

}  // namespace

std::string problemOf(const MediumPoint& point, const MediumPoint* previous) {
    if (!std::isfinite(point.value)) return fmt::format("expected a finite value, got {}", point.value);
    if (previous && !(point.value > previous->value))
        return fmt::format("expected a value above {}, got {}", previous->value, point.value);
    return problemOf(point.material);
}

// Ramps have a width: a table of evenly spaced entries has no room for a jump.
std::string problemOf(const MediumRegion& region) {
    const auto& v = region.value;
    const auto& g = region.gradient;
    if (!(std::isfinite(v[0]) && std::isfinite(v[3]) && v[0] < v[1] && v[1] <= v[2] && v[2] < v[3]))
        return "expected four finite values A < B <= C < D, got " + fourNumbers(v);
    const bool rises = g[0] >= 0 && (g[0] < g[1] || g[1] == 0) && std::isfinite(g[1]);
    const bool falls = g[1] <= g[2] && (g[2] < g[3] || g[2] == kInfinity);
    if (!(rises && falls))
        return "expected four gradient magnitudes 0 <= A < B <= C < D, or 0 0 at the beginning, or inf at "
               "the "
               "end, got " +
               fourNumbers(g);
    return problemOf(region.material);
}

std::string problemOfReference(double metres) {
    if (metres >= kShortest && metres <= kLongest) return "";
    return fmt::format("expected a reference length of {} to {} mm, got {}", kShortest * 1e3, kLongest * 1e3,
                       metres * 1e3);
}

namespace {

void checkReference(double metres, const std::string& source) {
    const std::string problem = problemOfReference(metres);
    if (!problem.empty())
        throw Error(source, "", problem,
                    "give the thickness of the layer that opacities are for, in millimetres");
}

// 0 <= x: 0 at or outside of t[0] and t[3], 1 between t[1] and t[2]. No ramp where both ends are the same.
double trapezoid(double x, const double (&t)[4]) {
    if (x >= t[1] && x <= t[2]) return 1;
    if (x < t[1]) return x <= t[0] ? 0 : (x / 2 - t[0] / 2) / (t[1] / 2 - t[0] / 2);
    if (t[3] == kInfinity) return 1;
    return x >= t[3] ? 0 : (t[3] / 2 - x / 2) / (t[3] / 2 - t[2] / 2);
}

// Adds materials up, each by its share of the extinction.
class Mixture {
public:
    explicit Mixture(double referenceLength) : mPerMetre(1 / referenceLength) {}

    void add(const MediumMaterial& m, double weight) {
        if (!(weight > 0 && m.opacity > 0)) return;  // opacity 0 is empty space, whatever its transport
        const double tau = -std::log1p(-std::min(m.opacity, MediumTransfer::kDensest)) * mPerMetre * weight;
        mExtinction += tau;
        mIndirect +=
            glm::dvec3(-glm::log(glm::dvec3(glm::max(m.transport, kLeastTransport)))) * mPerMetre * weight;
        mColor += tau * glm::dvec3(m.color);
        mSurface += tau * m.surface;
        mGlow += tau * glm::dvec3(m.glow);
    }
    OpticalProperties result() const {
        OpticalProperties p;
        if (!(mExtinction > 0)) return p;
        p.extinction = static_cast<float>(mExtinction);
        p.indirectExtinction = mIndirect;
        p.color = glm::min(glm::dvec3(mColor / mExtinction), 1.0);
        p.surface = static_cast<float>(std::min(mSurface / mExtinction, 1.0));
        p.glow = mGlow / mExtinction;
        return p;
    }

private:
    double mPerMetre;
    double mExtinction = 0, mSurface = 0;
    glm::dvec3 mColor{0.0}, mIndirect{0.0}, mGlow{0.0};
};

void mixPoints(const std::vector<MediumPoint>& points, double value, Mixture& mixture) {
    const auto above = std::upper_bound(points.begin(), points.end(), value,
                                        [](double v, const MediumPoint& p) { return v < p.value; });
    if (above == points.begin() || above == points.end()) {
        mixture.add(above == points.begin() ? above->material : (above - 1)->material, 1);
        return;
    }
    const MediumPoint& below = *(above - 1);
    // Halves: the difference of two finite numbers may be infinite.
    const double share = (value / 2 - below.value / 2) / (above->value / 2 - below.value / 2);
    mixture.add(below.material, 1 - share);
    mixture.add(above->material, share);
}

}  // namespace

MediumTransfer::MediumTransfer(std::vector<MediumPoint> points, double referenceLength,
                               const std::string& source)
    : mPoints(std::move(points)), mReferenceLength(referenceLength) {
    checkReference(referenceLength, source);
    for (std::size_t n = 0; n < mPoints.size(); ++n) {
        const std::string problem = problemOf(mPoints[n], n > 0 ? &mPoints[n - 1] : nullptr);
        if (!problem.empty()) throw Error(source, "point " + std::to_string(n + 1), problem, kAdvice);
    }
}

MediumTransfer::MediumTransfer(std::vector<MediumRegion> regions, double referenceLength,
                               const std::string& source)
    : mRegions(std::move(regions)), mReferenceLength(referenceLength) {
    checkReference(referenceLength, source);
    for (std::size_t n = 0; n < mRegions.size(); ++n) {
        const std::string problem = problemOf(mRegions[n]);
        if (!problem.empty()) throw Error(source, "region " + std::to_string(n + 1), problem, kAdvice);
    }
}

void MediumTransfer::setSurfaceRamp(double low, double high, const std::string& source) {
    if (!(low >= 0 && low < high && std::isfinite(high)))
        throw Error(source, "surface gradient",
                    fmt::format("expected 0 <= LOW < HIGH, got {} and {}", low, high),
                    "give the gradient magnitudes at which the surface weight is 0 and full");
    mSurfaceLow = low;
    mSurfaceHigh = high;
}

OpticalProperties MediumTransfer::at(double value, double gradient) const {
    Mixture mixture(mReferenceLength);
    if (!mPoints.empty()) mixPoints(mPoints, value, mixture);
    for (const MediumRegion& region : mRegions)
        mixture.add(region.material, trapezoid(value, region.value) * trapezoid(gradient, region.gradient));
    OpticalProperties result = mixture.result();
    if (hasSurfaceRamp())
        result.surface *=
            static_cast<float>(std::clamp((gradient - mSurfaceLow) / (mSurfaceHigh - mSurfaceLow), 0.0, 1.0));
    return result;
}

MediumTransfer::Range MediumTransfer::visibleRange() const {
    Range range{kInfinity, -kInfinity};
    for (const MediumRegion& r : mRegions) {
        if (!(r.material.opacity > 0)) continue;
        range.lowest = std::min(range.lowest, r.value[0]);
        range.highest = std::max(range.highest, r.value[3]);
    }
    const auto visible = [](const MediumPoint& p) { return p.material.opacity > 0; };
    const auto first = std::find_if(mPoints.begin(), mPoints.end(), visible);
    if (first == mPoints.end()) return range;
    const auto last = std::find_if(mPoints.rbegin(), mPoints.rend(), visible);
    return {first == mPoints.begin() ? -kInfinity : (first - 1)->value,
            last == mPoints.rbegin() ? kInfinity : (last - 1)->value};
}

MediumTransfer::Range MediumTransfer::changingRange() const {
    if (!mPoints.empty()) return {mPoints.front().value, mPoints.back().value};
    return visibleRange();
}

double MediumTransfer::largestGradient() const {
    double largest = hasSurfaceRamp() ? mSurfaceHigh : 0;
    for (const MediumRegion& region : mRegions)
        for (const double g : region.gradient)
            if (std::isfinite(g)) largest = std::max(largest, g);
    return largest;
}

}  // namespace stereonav
