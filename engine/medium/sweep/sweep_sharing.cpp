// With eye directions d = forward + right x + up y the place of a ray in the plane dot(axis, p) = t has the
// depth (t - start) / dot(axis, d), so 1 / depth is affine in the pixel's coordinates, and so is the shift
// separation / depth of what the other eye sees there: exact, with no row left.
#include "engine/medium/sweep/sweep_sharing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

// Largest parallax (tangent) at which samples are shared: phase functions, highlights and the length of ways
// through a slab are the first eye's, or nearly.
constexpr double kMostParallax = 1.0 / 8;
// How far beside the row the other eye may lie, as a share of the separation: at the largest parallax a
// hundredth of a pixel where a thousand of them span a radian.
constexpr double kMostAside = 1e-4;

bool sideBySide(const RayFan& a, const RayFan& b, const glm::dvec3& between) {
    const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-9 * std::abs(x); };
    const auto along = [](const glm::dvec3& x, const glm::dvec3& y) { return glm::length(x - y) <= 1e-9; };
    const double separation = glm::dot(between, b.right);
    return !a.parallel && !b.parallel && a.width == b.width && a.height == b.height && a.width >= 2 &&
           near(a.perX, b.perX) && near(a.perY, b.perY) && std::abs(a.yMax - b.yMax) <= 1e-3 * b.perY &&
           along(a.right, b.right) && along(a.up, b.up) && along(a.forward, b.forward) &&
           glm::length(between - separation * b.right) <= kMostAside * std::abs(separation);
}

}  // namespace

double finestDetail(const Medium& medium) {
    double finest = kInfinity;
    if (const GreyVolume* field = medium.field())
        finest = std::min({field->frame.spacing.x, field->frame.spacing.y, field->frame.spacing.z});
    for (const HeightLayer& layer : medium.layers()) {
        finest = std::min({finest, layer.spacing, layer.taper});
        if (layer.color) finest = std::min(finest, layer.colorTexel());
    }
    if (!medium.noise()) return finest;
    for (const NoiseScale& scale : medium.perturbation().scales) {
        const bool counts = scale.displacement != 0 || scale.extinction != 0 ||
                            scale.color != glm::vec3(0.0f) || scale.indirect != glm::vec3(0.0f);
        if (counts) finest = std::min(finest, scale.size / NoiseVolume::kSize);
    }
    return finest;
}

SweepSharing::SweepSharing(const SweepGeometry& geometry, const WorldBox& box, double widestPixel) {
    if (!(widestPixel > 0) || geometry.eyes.size() != 2 || geometry.slabs() == 0) return;
    const RayFan &first = geometry.eyes[0], &second = geometry.eyes[1];
    const glm::dvec3 between = second.origin - first.origin;
    if (!sideBySide(first, second, between)) return;
    mAny = true;
    mForward = geometry.forward;
    mSeparation = glm::dot(between, second.right);
    mStart = glm::dot(second.origin, geometry.axis);
    mAxisRight = glm::dot(second.right, geometry.axis);
    mPixel = second.perX;
    mWidestPixel = widestPixel;
    mColumn = static_cast<float>((second.xMin - first.xMin) / second.perX - 0.5);
    mWidth = second.width;
    for (int n = 0; n < 4; ++n) {
        const double x = second.xMin + (n & 1 ? second.width * second.perX : 0),
                     y = second.yMax - (n & 2 ? second.height * second.perY : 0);
        mCosines[n] = glm::dot(geometry.axis, second.forward + x * second.right + y * second.up);
    }
    mNearest = kInfinity;
    for (int n = 0; n < 8; ++n) {
        const glm::dvec3 corner(n & 1 ? box.high.x : box.low.x, n & 2 ? box.high.y : box.low.y,
                                n & 4 ? box.high.z : box.low.z);
        const double depth = second.depthOf(corner - geometry.anchor);
        mNearest = std::min(mNearest, depth);
        mFarthest = std::max(mFarthest, depth);
    }
}

// Returns whether a plane `away` from the eye along the axis is shared. parallax: tangent, of a ray with the
// cosine 1 to the axis.
bool SweepSharing::share(double away, double& parallax) const {
    if (!(mForward ? away > 0 : away < 0)) return false;
    double nearest = kInfinity, farthest = 0;
    for (const double cosine : mCosines) {
        const double depth = away * cosine > 0 ? away / cosine : kInfinity;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    nearest = std::max(nearest, mNearest);
    farthest = std::min(farthest, mFarthest);
    parallax = mSeparation / away;
    return farthest * mPixel <= mWidestPixel && std::abs(mSeparation) <= kMostParallax * nearest &&
           std::abs(parallax * mAxisRight) <= kMostParallax;
}

std::uint32_t SweepSharing::slabsOf(const SweepChunk& chunk, int count, SharedRows& rows) const {
    std::uint32_t shared = 0;
    if (!mAny) return shared;
    rows.width = mWidth;
    rows.column = mColumn;
    rows.perParallax = static_cast<float>(1 / mPixel);
    double most = -kInfinity;
    for (int n = 0; n < count; ++n) {
        double parallax = 0;
        if (!share(chunk.reference + chunk.middle[n] - mStart, parallax)) continue;
        shared |= 1u << n;
        for (const double cosine : mCosines) most = std::max(most, cosine * parallax / mPixel);
        rows.parallax[n] = static_cast<float>(parallax);
        rows.lengthening[n] = static_cast<float>(1 + parallax * mAxisRight);
    }
    rows.farthest = mColumn + static_cast<float>(most);
    return shared;
}

}  // namespace stereonav
