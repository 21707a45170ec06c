// See the header. Everything follows from the medium's box, the light and the views; no state, so that the
// same view always has the same slices.
#include "engine/medium/sweep/sweep_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "engine/base/error.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

// Eye rays stay below it where a wide lamp would lean the axis further: radians.
constexpr double kSteepest = 85.0 / 180.0 * glm::pi<double>();
constexpr double kWidestLight = 1;  // tangent: a lamp's buffer grows no further beyond its cone
// Angle from view to light, radians: where V11 of docs/volume_light.md begins and where it counts in full.
constexpr double kLeansFrom = 50.0 / 180.0 * glm::pi<double>(), kLeansTo = 75.0 / 180.0 * glm::pi<double>();
constexpr int kLightMargin = 1;  // texels around the medium, so that reads in it never meet the border

void checkSetting(const SweepSetting& s) {
    const auto expect = [](bool good, const char* what, const std::string& problem) {
        if (!good) throw Error("", what, problem, "change it");
    };
    expect(s.slices >= 1 && s.slices <= 65536, "slices",
           fmt::format("expected 1 to 65536, got {}", s.slices));
    expect(s.turn >= 0 && s.turn < 1, "turn", fmt::format("expected 0 or more and below 1, got {}", s.turn));
    expect(s.lightSize >= 8 && s.lightSize <= 4096, "light size",
           fmt::format("expected 8 to 4096 texels, got {}", s.lightSize));
    expect(s.coneAngle >= 0 && s.coneAngle < 3.0, "cone angle",
           fmt::format("expected 0 or more and below 3 radians, got {}", s.coneAngle));
    expect(s.sharedWidth >= 0, "shared width", fmt::format("expected 0 or more, got {}", s.sharedWidth));
    expect(s.blurLength >= 0 && s.blurLength < kInfinity, "blur length",
           fmt::format("expected 0 or more metres, got {}", s.blurLength));
}

void checkLight(const MediumLight& light) {
    const double length = glm::length(light.direction);
    if (!(std::abs(length - 1) < 1e-6))
        throw Error("", "light direction",
                    fmt::format("expected a unit vector, got one of length {}", length), "normalise it");
    if (light.kind == MediumLight::Kind::Lamp && !(light.coneAngle > 0 && light.coneAngle < 2.8))
        throw Error("", "lamp cone angle",
                    fmt::format("expected above 0 and below 2.8 radians, got {}", light.coneAngle),
                    "choose a narrower cone or a parallel light");
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {  // exact also for tiny ones
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

glm::dvec3 middleView(std::span<const EyeView> eyes) {
    glm::dvec3 sum(0.0);
    for (const EyeView& eye : eyes) sum += eye.forward;
    const double length = glm::length(sum);
    if (length > 1e-6) return sum / length;
    return eyes.empty() ? glm::dvec3(0, 0, -1) : eyes.front().forward;
}

// The largest angle of any eye's rays from `middle`.
double halfAngleOf(std::span<const EyeView> eyes, const glm::dvec3& middle) {
    double widest = 0;
    for (const EyeView& eye : eyes)
        for (int corner = 0; corner < 4; ++corner)
            widest = std::max(widest, angleBetween(eye.rayDirection(corner & 1 ? eye.width : 0,
                                                                    corner & 2 ? eye.height : 0),
                                                   middle));
    return widest;
}

// Returns the lean of the axis from the view towards the light, radians. Where a lamp's cone is too wide for
// all rays, the eyes' rays have priority; the lean stays at least that for parallel light.
double leanOf(double beta, double lightHalf, double eyeHalf) {
    const double wanted = 0.5 * (beta + lightHalf - eyeHalf);
    const double parallel = 0.5 * (beta - eyeHalf);
    return std::clamp(std::max(std::min(wanted, kSteepest - eyeHalf), parallel), 0.0, beta);
}

struct Lamp {  // also parallel light: where it goes
    bool parallel = true;
    glm::dvec3 position{0.0}, direction{0, 0, -1};
    double half = 0;  // half the angle of its cone
};

Lamp lampOf(const MediumLight& light, const glm::dvec3& head, const glm::dvec3& view) {
    Lamp lamp;
    lamp.parallel = light.kind == MediumLight::Kind::Parallel;
    lamp.direction = light.direction;
    if (lamp.parallel) return lamp;
    lamp.position = light.atHead ? head : light.position;
    if (light.atHead) lamp.direction = view;
    lamp.half = 0.5 * light.coneAngle;
    return lamp;
}

void setAxis(SweepGeometry& g, const Lamp& lamp, const glm::dvec3& view, double eyeHalf) {
    g.forward = glm::dot(lamp.direction, view) >= 0;
    const glm::dvec3 from = g.forward ? view : -view;
    const double beta = angleBetween(from, lamp.direction);
    const glm::dvec3 aside = lamp.direction - glm::dot(lamp.direction, from) * from;
    const double length = glm::length(aside);
    const double lean = leanOf(beta, lamp.half, eyeHalf);
    g.leaning = glm::smoothstep(kLeansFrom, kLeansTo, beta);
    g.axis = length > 0 ? glm::normalize(std::cos(lean) * from + std::sin(lean) / length * aside) : from;
}

// Returns distances of slabs ahead of an eye inside the medium, `length` of it: slabs grow with the distance,
// the last being about kGrowth times the first. What is near fills most of the picture there, and even slabs
// would show in it as rings.
std::vector<double> gradedSteps(double length, int slices, double turn) {
    constexpr double kGrowth = 64;
    std::vector<double> distances;
    distances.reserve(static_cast<std::size_t>(slices) + 1);
    for (int k = 1; k <= slices; ++k)
        distances.push_back(length * (std::pow(kGrowth, (static_cast<double>(k) - turn) / slices) - 1) /
                            (kGrowth - 1));
    if (turn > 0)
        distances.push_back(length);
    else
        distances.back() = length;
    return distances;
}

// Returns even faces over the box, of the medium alone, so that they stand still as one flies around it; for
// an eye inside, graded ones ahead of it.
std::vector<double> evenOrGraded(double low, double high, bool forward, const SweepSetting& setting,
                                 double eye) {
    std::vector<double> faces;
    const int slices = setting.slices;
    const double turn = setting.turn;
    const bool inside = eye > low && eye < high;
    if (inside && !forward) {
        faces = gradedSteps(eye - low, slices, turn);
        std::reverse(faces.begin(), faces.end());
        for (double& face : faces) face = eye - face;
        faces.push_back(eye);
        return faces;
    }
    for (int k = 0; k <= slices + (turn > 0 ? 1 : 0); ++k) {
        const double share = std::clamp((static_cast<double>(k) - turn) / slices, 0.0, 1.0);
        const double face = low + (high - low) * share;
        if (!inside || face < eye) faces.push_back(face);
    }
    if (!inside) return faces;
    faces.push_back(eye);
    for (const double d : gradedSteps(high - eye, slices, turn)) faces.push_back(eye + d);
    return faces;
}

// Returns the faces of the slabs, among them the planes of eyes and lamp where these lie inside: so each slab
// is wholly before or wholly behind them.
std::vector<double> facesOf(const WorldBox& box, const SweepGeometry& g, const SweepSetting& setting,
                            const std::vector<double>& planes, double eye) {
    const double middle = glm::dot(g.axis, box.center() - g.anchor);
    const double half = 0.5 * glm::dot(glm::abs(g.axis), box.high - box.low);
    std::vector<double> faces = evenOrGraded(middle - half, middle + half, g.forward, setting, eye);
    const double near = 1e-6 * 2 * half / setting.slices;
    for (const double plane : planes) {
        const auto above = std::lower_bound(faces.begin(), faces.end(), plane);
        if (above == faces.begin() || above == faces.end()) continue;
        if (*above - plane > near && plane - *(above - 1) > near) faces.insert(above, plane);
    }
    return faces;
}

// Takes away slabs that no eye sees and that no light crosses on its way to one that is seen.
void dropUnseen(SweepGeometry& g, bool usesLight, double lowEye, double highEye) {
    std::vector<double>& f = g.faces;
    if (!g.forward) {
        while (f.size() >= 2 && f[f.size() - 2] >= highEye) f.pop_back();
    } else if (f.back() <= lowEye) {
        f.clear();
    } else {
        const double low = usesLight ? std::min(lowEye, g.lightStart) : lowEye;
        std::size_t first = 0;
        while (first + 2 < f.size() && f[first + 1] <= low) ++first;
        f.erase(f.begin(), f.begin() + static_cast<std::ptrdiff_t>(first));
    }
    if (f.size() < 2) f.clear();
}

RayFan fanOf(const EyeView& eye, const glm::dvec3& anchor) {
    RayFan fan;
    fan.origin = eye.eye - anchor;
    fan.right = eye.right;
    fan.up = eye.up;
    fan.forward = eye.forward;
    fan.xMin = eye.xMin;
    fan.yMax = eye.yMax;
    fan.perX = eye.pixelWidth();
    fan.perY = eye.pixelHeight();
    fan.width = eye.width;
    fan.height = eye.height;
    return fan;
}

// The axes turned from (x, y, -z) to `forward` the shortest way: they change evenly with it but where it
// points straight up.
void setAxes(RayFan& fan, const glm::dvec3& forward) {
    const glm::dvec3 f = fan.forward = forward;
    const double s = 1 - f.z;
    if (s < 1e-12) {
        fan.right = {1, 0, 0};
        fan.up = {0, -1, 0};
        return;
    }
    fan.right = {1 - f.x * f.x / s, -f.x * f.y / s, f.x};
    fan.up = {-f.x * f.y / s, 1 - f.y * f.y / s, f.y};
}

// A window in the fan's plane: metres, or at unit distance.
struct Window {
    double xMin = kInfinity, xMax = -kInfinity, yMin = kInfinity, yMax = -kInfinity;

    void hold(double x, double y) {
        xMin = std::min(xMin, x);
        xMax = std::max(xMax, x);
        yMin = std::min(yMin, y);
        yMax = std::max(yMax, y);
    }
    void clip(double most) {
        xMin = std::clamp(xMin, -most, most);
        xMax = std::clamp(xMax, -most, most);
        yMin = std::clamp(yMin, -most, most);
        yMax = std::clamp(yMax, -most, most);
    }
};

glm::dvec3 cornerOf(const WorldBox& box, int n) {
    return {n & 1 ? box.high.x : box.low.x, n & 2 ? box.high.y : box.low.y, n & 4 ? box.high.z : box.low.z};
}

// Returns the window that the box covers, seen along the light; of a lamp with a part of the box behind it:
// the whole cone.
Window windowOf(const RayFan& fan, const WorldBox& box, const glm::dvec3& anchor, double most) {
    Window window;
    for (int n = 0; n < 8; ++n) {
        const glm::dvec3 d = cornerOf(box, n) - anchor - fan.origin;
        const double depth = fan.parallel ? 1.0 : glm::dot(d, fan.forward);
        if (depth <= 0) return {-most, most, -most, most};
        window.hold(glm::dot(d, fan.right) / depth, glm::dot(d, fan.up) / depth);
    }
    if (!fan.parallel) window.clip(most);
    return window;
}

int texelsOver(double length, double per) {
    return static_cast<int>(std::ceil(length / per - 1e-9)) + 2 * kLightMargin;
}

// How far light that is scattered on its way through the box gets beside a lamp's cone: three standard
// deviations at unit depth. V9's taps of a step ds spread by ds blurLength tan^2(theta / 2) / 2 along each
// axis, which is as much at unit depth over the square of the depth; summed from depth near to far. At most
// as far again as the cone is wide, so that texels in it are at most twice as large, and to 45 degrees: near
// a lamp inside, more is lost.
double spreadBeside(const RayFan& fan, const Lamp& lamp, const WorldBox& box, const glm::dvec3& anchor,
                    double blur) {
    double near = kInfinity, far = 0;
    for (int n = 0; n < 8; ++n) {
        const double depth = glm::dot(cornerOf(box, n) - anchor - fan.origin, fan.forward);
        near = std::min(near, depth);
        far = std::max(far, depth);
    }
    const double widest = std::min(std::tan(lamp.half), std::max(kWidestLight - std::tan(lamp.half), 0.0));
    if (!(far > 0) || !(blur > 0)) return 0;
    if (!(near > 0)) return widest;
    return std::min(3 * blur * std::sqrt(0.5 * (1 / near - 1 / far)), widest);
}

// blur: of scattered light, V9's offset over the root of the way; 0: none is.
void setTexels(RayFan& fan, const Lamp& lamp, const WorldBox& box, const glm::dvec3& anchor, int size,
               double blur) {
    const double most =
        lamp.parallel ? kInfinity : std::tan(lamp.half) + spreadBeside(fan, lamp, box, anchor, blur);
    const Window w = windowOf(fan, box, anchor, most);
    const double across = w.xMax - w.xMin, down = w.yMax - w.yMin;
    // A lamp that lights nothing of the box has no window: the smallest buffer.
    const double least = lamp.parallel ? 1e-300 : 1e-9;
    fan.perX = fan.perY = std::max({across, down, least}) / (size - 2 * kLightMargin);
    fan.width = std::clamp(texelsOver(across, fan.perX), 1 + 2 * kLightMargin, size);
    fan.height = std::clamp(texelsOver(down, fan.perY), 1 + 2 * kLightMargin, size);
    fan.xMin = 0.5 * (w.xMin + w.xMax) - 0.5 * fan.width * fan.perX;
    fan.yMax = 0.5 * (w.yMin + w.yMax) + 0.5 * fan.height * fan.perY;
}

void setLight(SweepGeometry& g, const MediumLight& light, const Lamp& lamp) {
    g.light.parallel = lamp.parallel;
    g.light.origin = lamp.parallel ? glm::dvec3(0.0) : lamp.position - g.anchor;
    setAxes(g.light, lamp.direction);
    g.radiance = light.radiance;
    g.lightStart = lamp.parallel ? -kInfinity : glm::dot(g.axis, lamp.position - g.anchor);
    g.falloff = lamp.parallel ? 0.0 : light.falloff;
    g.lampCosine = lamp.parallel ? -1.0 : std::cos(lamp.half);
}

}  // namespace

glm::dvec3 RayFan::start(double x, double y) const {
    return parallel ? origin + right * (xMin + x * perX) + up * (yMax - y * perY) : origin;
}

glm::dvec3 RayFan::direction(double x, double y) const {
    return parallel ? forward : glm::normalize(forward + right * (xMin + x * perX) + up * (yMax - y * perY));
}

glm::dvec2 RayFan::project(const glm::dvec3& place) const {
    const glm::dvec3 d = place - origin;
    const double depth = parallel ? 1.0 : glm::dot(d, forward);
    if (!(depth > 0)) return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
    return {(glm::dot(d, right) / depth - xMin) / perX, (yMax - glm::dot(d, up) / depth) / perY};
}

double RayFan::depthOf(const glm::dvec3& place) const {
    return glm::dot(place - origin, forward);
}

double RayFan::pixelSize(const glm::dvec3& place) const {
    return parallel ? perX : perX * depthOf(place);
}

SweepGeometry makeSweepGeometry(const Medium& medium, const MediumLook& look, const SweepSetting& setting,
                                std::span<const EyeView> eyes, const glm::dvec3& head) {
    checkSetting(setting);
    checkLight(look.light);
    const WorldBox& box = medium.bounds();
    const glm::dvec3 view = middleView(eyes);
    const Lamp lamp = lampOf(look.light, head, view);
    SweepGeometry g;
    g.anchor = box.empty() ? head : glm::clamp(head, box.low, box.high);
    setAxis(g, lamp, view, halfAngleOf(eyes, view));
    setLight(g, look.light, lamp);
    double lowEye = kInfinity, highEye = -kInfinity;
    std::vector<double> planes;
    for (const EyeView& eye : eyes) {
        g.eyes.push_back(fanOf(eye, g.anchor));
        planes.push_back(glm::dot(g.axis, g.eyes.back().origin));
        lowEye = std::min(lowEye, planes.back());
        highEye = std::max(highEye, planes.back());
    }
    if (box.empty() || eyes.empty()) return g;
    if (!lamp.parallel) planes.push_back(g.lightStart);
    g.faces = facesOf(box, g, setting, planes, g.forward ? lowEye : highEye);
    const bool usesLight = look.model == MediumModel::Direct || look.model == MediumModel::Indirect;
    dropUnseen(g, usesLight, lowEye, highEye);
    const double blur = look.model == MediumModel::Indirect ? blurOf(medium, setting) : 0.0;
    if (usesLight && !g.faces.empty()) setTexels(g.light, lamp, box, g.anchor, setting.lightSize, blur);
    return g;
}

double blurOf(const Medium& medium, const SweepSetting& setting) {
    const glm::dvec3 size = medium.bounds().high - medium.bounds().low;
    const double length =
        setting.blurLength > 0 ? setting.blurLength : std::max({size.x, size.y, size.z}) / 64;
    return std::sqrt(length) * std::tan(0.5 * setting.coneAngle);
}

std::vector<float> scatteredAtStart(const SweepGeometry& geometry) {
    const RayFan& fan = geometry.light;
    if (fan.parallel || fan.width == 0) return {};
    const double edge = std::sqrt(1 / (geometry.lampCosine * geometry.lampCosine) - 1);  // tangent
    std::vector<float> start;
    start.reserve(static_cast<std::size_t>(fan.width + 2) * (fan.height + 2));
    bool all = true;
    for (int y = -1; y <= fan.height; ++y)
        for (int x = -1; x <= fan.width; ++x) {
            const double u = fan.xMin + (x + 0.5) * fan.perX, v = fan.yMax - (y + 0.5) * fan.perY;
            start.push_back(
                static_cast<float>(std::clamp((edge - std::hypot(u, v)) / fan.perX + 0.5, 0.0, 1.0)));
            all = all && start.back() == 1;
        }
    return all ? std::vector<float>{} : start;
}

}  // namespace stereonav
