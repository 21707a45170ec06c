#include "terrain/cast/terrain_view.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

constexpr double kBandWidth = 64;    // lanes of straight bands: whole packets
constexpr double kFanWidth = 112;    // lanes of fanned bands where they are widest: few cut packets
constexpr double kMaxBandSlope = 2;  // lanes a step; see the margins in caster_kernel.cpp

// Straight down, as a homogeneous point of the image plane in pixel coordinates (centre of pixel
// (0, 0) at (0, 0)). From pixel p, lower rays lie towards (x - p.x w, y - p.y w).
struct Nadir {
    double x, y, w;
};

Nadir nadirOf(const EyeView& view) {
    const double w = -view.forward.z;
    const double x = (-view.right.z - view.xMin * w) / view.pixelWidth() - 0.5 * w;
    const double y = (view.yMax * w + view.up.z) / view.pixelHeight() - 0.5 * w;
    return {x, y, w};
}

void orient(CasterView& v, const EyeView& view, const Nadir& nadir) {
    const double downX = nadir.x - 0.5 * (view.width - 1) * nadir.w;
    const double downY = nadir.y - 0.5 * (view.height - 1) * nadir.w;
    const bool upright = std::abs(downY) >= std::abs(downX);
    const double down = upright ? downY : downX;
    const int step = down > 0 ? -1 : 1;
    v.lanes = upright ? view.width : view.height;
    v.steps = upright ? view.height : view.width;
    v.laneX = upright;
    v.laneY = !upright;
    v.stepX = upright ? 0 : step;
    v.stepY = upright ? step : 0;
    v.firstX = v.stepX < 0 ? view.width - 1 : 0;
    v.firstY = v.stepY < 0 ? view.height - 1 : 0;
    v.lowA = upright ? nadir.x : nadir.y;
    v.lowQ = upright ? (nadir.y - v.firstY * nadir.w) * step : (nadir.x - v.firstX * nadir.w) * step;
    v.lowW = nadir.w;
}

void setDirections(CasterView& v, const EyeView& view, const glm::dvec2& spacing) {
    const glm::dvec3 perX = view.right * view.pixelWidth(), perY = -view.up * view.pixelHeight();
    const glm::dvec3 base = view.rayDirection(v.firstX + 0.5, v.firstY + 0.5);
    const glm::dvec3 perLane = v.laneX ? perX : perY;
    const glm::dvec3 perStep = perX * double(v.stepX) + perY * double(v.stepY);
    for (int k = 0; k < 3; ++k) {
        const double scale = k == 0 ? 1 / spacing.x : k == 1 ? 1 / spacing.y : 1.0;
        v.base[k] = base[k] * scale;
        v.perLane[k] = perLane[k] * scale;
        v.perStep[k] = perStep[k] * scale;
    }
    v.verticalColumns = std::hypot(perStep.x, perStep.y) <= 1e-13 * std::abs(perStep.z);
}

// Turns the bend around the head into that around the eye: (d + e)^2 - d^2 = 2 d e + e^2, where e leads from
// the head to the eye.
void bendAroundEye(CasterView& v, const EyeView& view, const glm::dvec2& spacing) {
    const glm::dvec2 e(view.eye - view.head);
    const auto turn = [&](double(&way)[3]) {
        way[2] += 2 * view.fall * (e.x * way[0] * spacing.x + e.y * way[1] * spacing.y);
    };
    v.fall = view.fall;
    v.originZ += view.bend().sinkAt(glm::dvec2(view.eye));
    turn(v.base), turn(v.perLane), turn(v.perStep);
}

// Slope of the band line through lane a at step q: lanes it moves for each step up.
double lineSlope(const CasterView& v, double a, double q) {
    const double lowQ = v.lowQ - q * v.lowW;
    return (v.lowA - a * v.lowW) / lowQ;
}

// Bands fan out from the nadir (or towards the zenith) where that point is far enough outside the
// picture; else they are straight.
struct Fan {
    bool open = false;
    double step = 0;            // where bands are widest
    double begin = 0, end = 0;  // lanes of the outermost lines there
    double width() const { return open ? kFanWidth : kBandWidth; }
    int count() const { return std::max(1, static_cast<int>(std::ceil((end - begin) / width()))); }
};

Fan fanOf(const CasterView& v) {
    const double first = v.lowQ, last = v.lowQ - (v.steps - 1) * v.lowW;
    Fan fan{false, 0, 0, double(v.lanes)};
    if (v.verticalColumns || !(first < 0 && last < 0) || std::max(first, last) / std::min(first, last) < 0.25)
        return fan;
    fan.step = std::abs(first) > std::abs(last) ? 0 : v.steps - 1;
    const double near = v.steps - 1 - fan.step, reach = fan.step - near;
    const double left = lineSlope(v, 0, near), right = lineSlope(v, v.lanes, near);
    if (std::max(std::abs(left), std::abs(right)) > kMaxBandSlope) return fan;
    fan.open = true;
    fan.begin = std::min(0.0, left * reach);
    fan.end = std::max(double(v.lanes), v.lanes + right * reach);
    return fan;
}

}  // namespace

CasterView makeCasterView(const EyeView& view, const Heightfield& ground) {
    CasterView v;
    const glm::dvec2 eye = ground.gridFromWorld(glm::dvec2(view.eye));
    v.originX = eye.x;
    v.originY = eye.y;
    v.originZ = view.eye.z;
    const Nadir nadir = nadirOf(view);
    orient(v, view, nadir);
    setDirections(v, view, ground.spacing());
    if (view.fall > 0) bendAroundEye(v, view, ground.spacing());
    v.nearDepth = static_cast<float>(view.nearDepth);
    v.pixelWidth = static_cast<float>(view.pixelWidth());
    v.pixelHeight = static_cast<float>(view.pixelHeight());
    const double height = ground.heightAt(glm::dvec2(view.eye));
    const bool above = view.eye.z > height;  // false over a hole: its height is NaN
    v.coherent = above && (v.verticalColumns || ground.contains(glm::dvec2(view.eye)));
    return v;
}

int bandCount(const CasterView& view) {
    return fanOf(view).count();
}

CasterBand bandOf(const CasterView& view, int index) {
    const Fan fan = fanOf(view);
    const int count = fan.count();
    CasterBand band;
    band.endStep = view.steps;
    // Lines are kept as value at step 0 and slope; the outermost take all that is left of them.
    const auto line = [&](int k, double& at, double& slope) {
        if (k == 0 || k == count) {
            at = k == 0 ? -1e9 : 1e9;
            slope = 0;
            return;
        }
        const double a = fan.begin + k * fan.width();
        slope = fan.open ? lineSlope(view, a, fan.step) : 0;
        at = a - slope * fan.step;
    };
    line(index, band.left, band.leftSlope);
    line(index + 1, band.right, band.rightSlope);
    return band;
}

}  // namespace stereonav
