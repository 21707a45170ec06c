// The built-in colon's axis, radii, folds and polyps, and the signed distance that they give.
#include "colon/built_in/built_in_anatomy.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

// x, y, z and the radius, mm: rectum, sigmoid, descending, splenic flexure, transverse, hepatic flexure,
// ascending, caecum.
struct Control {
    glm::dvec3 place;
    double radius;
    double turn = 0;  // on a line through them: place on the spline
};
constexpr Control kControls[] = {
    {{0, 70, -138}, 15},   {{0, 80, -118}, 22},  {{0, 80, -98}, 22},     {{0, 66, -80}, 18},
    {{-14, 44, -72}, 15},  {{-40, 22, -82}, 14}, {{-58, -12, -104}, 14}, {{-40, -48, -112}, 15},
    {{-2, -62, -100}, 15}, {{22, -46, -76}, 14}, {{34, -14, -78}, 14},   {{52, 10, -102}, 14},
    {{84, 22, -110}, 14},  {{112, 38, -92}, 15}, {{122, 52, -60}, 16},   {{122, 62, -25}, 17},
    {{122, 62, 15}, 17},   {{120, 56, 55}, 17},  {{114, 44, 92}, 16},    {{110, 36, 128}, 15},
    {{98, 16, 150}, 14},   {{86, -6, 126}, 15},  {{80, -30, 88}, 17},    {{74, -62, 50}, 19},
    {{46, -74, 14}, 20},   {{8, -78, -6}, 20},   {{-32, -74, 4}, 20},    {{-62, -66, 32}, 20},
    {{-70, -44, 70}, 19},  {{-66, -6, 98}, 19},  {{-90, 22, 116}, 19},   {{-114, 40, 92}, 20},
    {{-118, 48, 54}, 22},  {{-116, 50, 16}, 24}, {{-112, 44, -24}, 25},  {{-104, 30, -58}, 26},
};
constexpr int kControlCount = static_cast<int>(std::size(kControls));

// Numbers in [0, 1) that depend on the seed, a stream and a count alone (splitmix64).
double unitNumber(std::uint64_t seed, std::uint64_t stream, std::uint64_t n) {
    std::uint64_t z =
        seed * 0x9E3779B97F4A7C15ull + stream * 0xD1B54A32D192ED03ull + n * 0x8CB92BA72F3D8DD7ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}
double between(double low, double high, double unit) {
    return low + (high - low) * unit;
}

// Returns the larger of two numbers, rounded by a quadratic polynomial where they are nearer than k.
double smoothMax(double a, double b, double k) {
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::max(a, b) + h * h * k * 0.25;
}

// Unevenness of the wall, mm: waves that run in directions which no grid has.
double unevenness(const glm::dvec3& p) {
    return 0.13 * std::sin(0.43 * p.x + 0.31 * p.y - 0.22 * p.z) +
           0.11 * std::sin(-0.27 * p.x + 0.40 * p.y + 0.37 * p.z + 1.3) +
           0.09 * std::sin(0.19 * p.x - 0.52 * p.y + 0.45 * p.z + 4.1) +
           0.07 * std::sin(0.61 * p.x + 0.17 * p.y + 0.53 * p.z + 2.2);
}

// A cubic through two points with their tangents.
glm::dvec3 placeBetween(const AxisPoint& a, const AxisPoint& b, double t) {
    const double u = 1 - t;
    return u * u * (1 + 2 * t) * a.place + t * t * (1 + 2 * u) * b.place +
           t * u * (u * a.tangent - t * b.tangent);
}

// Uniform cubic B-spline through space: bends twice as smoothly as an interpolating one, and stays inside.
Control splineAt(const std::vector<Control>& c, double u) {
    const int i = std::clamp(static_cast<int>(u), 0, static_cast<int>(c.size()) - 4);
    const double t = u - i, s = 1 - t;
    const double w[4] = {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                         (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6};
    Control sum{{0, 0, 0}, 0, u};
    for (int k = 0; k < 4; ++k) {
        sum.place += w[k] * c[i + k].place;
        sum.radius += w[k] * c[i + k].radius;
    }
    return sum;
}

// Returns a point of the spline, wound about itself a little: a real colon is longer than its way.
Control windingAt(const std::vector<Control>& c, double u) {
    Control now = splineAt(c, u);
    const double phase = 2 * kPi * u / 4.2 + 1.75;
    now.place *= glm::dvec3(1.056, 1.02, 1.04);
    now.place += glm::dvec3(13 * std::sin(phase), 10.4 * std::cos(0.93 * (phase - 1.75) + 1.75),
                            11.7 * std::sin(1.11 * (phase - 1.75) + 2.75));
    return now;
}

std::vector<Control> wobbledControls(std::uint64_t seed) {
    std::vector<Control> controls(std::begin(kControls), std::end(kControls));
    for (int n = 0; n < kControlCount; ++n)
        for (int axis = 0; axis < 3; ++axis)
            controls[n].place[axis] += between(-2, 2, unitNumber(seed, 1, 3 * n + axis));
    // Ends repeated by mirroring, so that the line reaches them.
    const Control first = controls.front(), last = controls.back();
    const Control before{2.0 * first.place - controls[1].place, first.radius};
    const Control after{2.0 * last.place - controls[kControlCount - 2].place, last.radius};
    controls.insert(controls.begin(), before);
    controls.push_back(after);
    return controls;
}

// Returns points of the line, one for every millimetre of its length.
std::vector<Control> evenlySpaced(const std::vector<Control>& line) {
    std::vector<Control> even;
    double walked = 0;
    for (std::size_t n = 1; n < line.size(); ++n) {
        const double step = glm::length(line[n].place - line[n - 1].place);
        while (step > 0 && static_cast<double>(even.size()) <= walked + step) {
            const double t = (static_cast<double>(even.size()) - walked) / step;
            even.push_back({glm::mix(line[n - 1].place, line[n].place, t),
                            line[n - 1].radius + t * (line[n].radius - line[n - 1].radius),
                            line[n - 1].turn + t * (line[n].turn - line[n - 1].turn)});
        }
        walked += step;
    }
    return even;
}

// Rounds bends off: a Gaussian of sigma points; beyond the ends the line is mirrored through them.
std::vector<Control> smoothed(const std::vector<Control>& line, int sigma) {
    const int count = static_cast<int>(line.size());
    std::vector<Control> smooth(line.size());
    for (int n = 0; n < count; ++n) {
        Control sum{{0, 0, 0}, 0, line[n].turn};
        double weights = 0;
        for (int k = -3 * sigma; k <= 3 * sigma; ++k) {
            const int at = n + k, end = std::clamp(at, 0, count - 1);
            const int mirrored = std::clamp(2 * end - at, 0, count - 1);
            const double w = std::exp(-0.5 * k * k / (sigma * sigma));
            const glm::dvec3 place =
                at == end ? line[at].place : 2.0 * line[end].place - line[mirrored].place;
            sum.place += w * place;
            sum.radius += w * line[mirrored].radius;
            weights += w;
        }
        smooth[n] = {sum.place / weights, sum.radius / weights, line[n].turn};
    }
    return smooth;
}

std::vector<Control> axisThrough(const std::vector<Control>& controls) {
    const int steps = (static_cast<int>(controls.size()) - 3) * 200;
    std::vector<Control> line(steps + 1);
    for (int n = 0; n <= steps; ++n) line[n] = windingAt(controls, n / 200.0);
    return evenlySpaced(smoothed(evenlySpaced(line), 12));
}

// Loops that lie elsewhere: the whole of them by slow waves through space and along the line.
void bendLoops(std::vector<Control>& controls, std::uint64_t seed, double bend) {
    for (std::size_t n = 0; n < controls.size(); ++n)
        for (int axis = 0; axis < 3; ++axis) {
            const double phase = 2 * kPi * unitNumber(seed, 30, axis), slow = static_cast<double>(n) / 3.1;
            controls[n].place[axis] += bend / std::sqrt(3.0) * std::sin(slow + phase + 0.9 * axis);
        }
}

// Millimetres along a line at which a place of the spline lies.
double indexOfTurn(const std::vector<Control>& line, double turn) {
    const auto after = std::ranges::lower_bound(line, turn, {}, &Control::turn);
    if (after == line.begin()) return 0;
    if (after == line.end()) return static_cast<double>(line.size() - 1);
    const Control &low = *(after - 1), &high = *after;
    return static_cast<double>(after - line.begin()) - (high.turn - turn) / (high.turn - low.turn);
}

// Returns where each millimetre of a line is on another line of the same spline.
std::vector<double> matchOf(const std::vector<Control>& from, const std::vector<Control>& to) {
    std::vector<double> match;
    for (std::size_t n = 0; n < from.size(); ++n)
        match.push_back(&from == &to ? static_cast<double>(n) : indexOfTurn(to, from[n].turn));
    return match;
}
}  // namespace

BuiltInAnatomy::BuiltInAnatomy(std::uint64_t seed, double gap, double bend, double inflation) {
    makeAxis(seed, bend, inflation);
    makeFrames();
    makeRoom(gap);
    makeFolds(seed);
    makePolyps(seed);
}

void BuiltInAnatomy::makeAxis(std::uint64_t seed, double bend, double inflation) {
    std::vector<Control> controls = wobbledControls(seed);
    const std::vector<Control> unbent = axisThrough(controls);
    bendLoops(controls, seed, bend);
    const std::vector<Control> line = bend == 0 ? unbent : axisThrough(controls);
    mBent = matchOf(unbent, line);
    std::vector<double> before(line.size());  // for each place: where it is on the unbent line
    for (std::size_t n = 0; n < line.size(); ++n)
        before[n] = bend == 0 ? static_cast<double>(n) : indexOfTurn(unbent, line[n].turn);
    for (std::size_t n = 0; n < line.size(); ++n) {
        const double along = before[n];
        const double slow = 1 + 0.07 * std::sin(along / 23 + 6 * unitNumber(seed, 2, 0)) +
                            0.05 * std::sin(along / 9.7 + 6 * unitNumber(seed, 2, 1));
        AxisPoint point;
        point.place = line[n].place;
        point.radius = inflation * std::clamp(line[n].radius * slow, 12.0, 30.0);
        mAxis.push_back(point);
    }
    makeFluid();
}

// Returns where a place of the unbent axis is on this one, mm along both.
double BuiltInAnatomy::bentAlong(double along) const {
    const double at = std::clamp(along, 0.0, static_cast<double>(mBent.size() - 1));
    const auto n = std::min(static_cast<std::size_t>(at), mBent.size() - 2);
    return mBent[n] + (at - static_cast<double>(n)) * (mBent[n + 1] - mBent[n]);
}

// Puts fluid into the descending part, which sags to the back and rises above the level at both ends.
void BuiltInAnatomy::makeFluid() {
    mFluid.y = 66;
    double first = length(), last = 0;
    for (int n = 0; n < static_cast<int>(mAxis.size()); ++n) {
        const AxisPoint& point = mAxis[n];
        if (point.place.x < 80 || point.place.y + point.radius + 2 < mFluid.y) continue;
        first = std::min<double>(first, n);
        last = std::max<double>(last, n);
    }
    mFluid.from = first - 12;
    mFluid.to = last + 12;
}

void BuiltInAnatomy::makeFrames() {
    const int count = static_cast<int>(mAxis.size());
    for (int n = 0; n < count; ++n) {
        const int a = std::max(n - 1, 0), b = std::min(n + 1, count - 1);
        mAxis[n].tangent = glm::normalize(mAxis[b].place - mAxis[a].place);
    }
    for (int n = 0; n < count; ++n) {
        const int a = std::max(n - 1, 0), b = std::min(n + 1, count - 1);
        mAxis[n].bend = (mAxis[b].tangent - mAxis[a].tangent) / static_cast<double>(b - a);
    }
    glm::dvec3 across(1, 0, 0);
    for (AxisPoint& point : mAxis) {
        across = glm::normalize(across - glm::dot(across, point.tangent) * point.tangent);
        point.across = across;
        point.over = glm::cross(point.tangent, across);
        const double turned = static_cast<double>(&point - mAxis.data()) / 400;
        point.turn = {std::cos(turned), std::sin(turned)};
    }
}

constexpr double kTightest = 0.75;  // radius of the tube over that of its bend

// Where loops come near to each other, both become narrower until the wall between them is thick enough.
void BuiltInAnatomy::makeRoom(double gap) {
    const int count = static_cast<int>(mAxis.size());
    std::vector<double> radius(count);
    for (int n = 0; n < count; ++n) {
        // No bend is tighter than the tube, or its inner side would fold into itself.
        radius[n] = std::min(mAxis[n].radius, kTightest / std::max(glm::length(mAxis[n].bend), 1e-9));
        for (int other = 0; other < count; ++other) {
            if (std::abs(other - n) < 95) continue;  // its own bend
            const double apart = glm::length(mAxis[n].place - mAxis[other].place);
            // Texture and the smoothing of folds take up to 1.5 mm of the two walls.
            const double room =
                (apart - gap - 1.5) * mAxis[n].radius / (mAxis[n].radius + mAxis[other].radius);
            radius[n] = std::min(radius[n], std::max(room, 6.0));
        }
    }
    for (int n = 0; n < count; ++n) {
        // Narrower neighbours on the line are approached by at most 0.3 mm a mm.
        double smallest = radius[n];
        for (int k = -40; k <= 40; ++k)
            smallest = std::min(smallest, radius[std::clamp(n + k, 0, count - 1)] + 0.3 * std::abs(k));
        mAxis[n].radius = smallest;
    }
    smoothRadii();
}

// Without kinks, and nowhere larger: each is a weighted mean of what is the least within the weights' reach.
void BuiltInAnatomy::smoothRadii() {
    constexpr int kReach = 16;
    constexpr double kSigma = 7;
    const int count = static_cast<int>(mAxis.size());
    const auto at = [&](int n) { return std::clamp(n, 0, count - 1); };
    std::vector<double> least(count);
    for (int n = 0; n < count; ++n) {
        least[n] = mAxis[n].radius;
        for (int k = -kReach; k <= kReach; ++k) least[n] = std::min(least[n], mAxis[at(n + k)].radius);
    }
    for (int n = 0; n < count; ++n) {
        double sum = 0, weights = 0;
        for (int k = -kReach; k <= kReach; ++k) {
            const double w = std::exp(-0.5 * k * k / (kSigma * kSigma));
            sum += w * least[at(n + k)];
            weights += w;
        }
        mAxis[n].radius = sum / weights;
    }
    for (int n = 0; n < count; ++n)
        mAxis[n].slope = 0.5 * (mAxis[at(n + 1)].radius - mAxis[at(n - 1)].radius);
}

// At the inner side of a bend, where the axis' millimetres are short, folds are lower, as they crowd there.
double BuiltInAnatomy::roomAt(const Fold& fold) const {
    const AxisPoint& point = mAxis[static_cast<int>(fold.along)];
    const glm::dvec3 middle = fold.cosine * point.across + fold.sine * point.over;
    const double bent = glm::dot(middle, point.bend) * point.radius;
    const double t = std::clamp((0.75 - bent) / 0.45, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

void BuiltInAnatomy::makeFolds(std::uint64_t seed) {
    for (int sector = 0; sector < 3; ++sector) {
        double along = between(8, 20, unitNumber(seed, 3, sector));
        for (int n = 0; along < unbentLength() - 12; ++n) {
            const auto number = [&](int which) { return unitNumber(seed, 4 + which, 3 * n + sector); };
            Fold fold;
            fold.along = bentAlong(along);
            fold.unbent = along;
            const double angle = sector * 2 * kPi / 3 + between(-0.15, 0.15, number(0)) + along / 400;
            fold.cosine = std::cos(angle);
            fold.sine = std::sin(angle);
            const double radius = mAxis[static_cast<int>(fold.along)].radius;
            // The rectum has but few low folds (Houston's valves), the rest high ones.
            const double share = along < 60 ? 0.30 : between(0.34, 0.55, number(1));
            fold.height = share * radius * roomAt(fold);
            fold.thickness = between(3.6, 5.2, number(2));
            fold.lean = between(-3, 3, number(3));
            if (fold.height > 2) mFolds.push_back(fold);
            along += (along < 60 ? 1.5 : 1.0) * between(15, 30, number(4));
        }
    }
    std::ranges::sort(mFolds, {}, &Fold::along);
    mNear.resize(mAxis.size());
    for (int n = 0; n < static_cast<int>(mAxis.size()); ++n) {
        const auto from = std::ranges::lower_bound(mFolds, n - 14.0, {}, &Fold::along);
        const auto to = std::ranges::upper_bound(mFolds, n + 14.0, {}, &Fold::along);
        mNear[n] = {static_cast<int>(from - mFolds.begin()), static_cast<int>(to - mFolds.begin())};
    }
}

// Signed distance to the folds' flesh, negative inside. to: from the axis' point, in the direction of this
// cosine and sine.
double BuiltInAnatomy::foldsAt(const AxisPoint& point, double along, const glm::dvec3& to, double cosine,
                               double sine, double radius) const {
    const double d = glm::length(to);
    // How long a mm of the axis is here.
    const double shrink = std::max(1 - glm::dot(to, point.bend), 0.3);
    double flesh = 30;
    const auto [from, end] =
        mNear[std::clamp(static_cast<int>(std::lround(along)), 0, static_cast<int>(mAxis.size()) - 1)];
    for (int n = from; n < end; ++n) {
        const Fold& fold = mFolds[n];
        const double c = cosine * fold.cosine + sine * fold.sine;
        if (c < 0.1) continue;
        // A crescent: its crest falls to the wall at the sector's edges, 64 degrees from its middle.
        const double crest = radius - fold.height * (c - 0.44) / 0.56;
        const double over = crest - d + 0.5 * fold.thickness;  // > 0: nearer the axis than the crest's round
        const double slant = fold.lean * (cosine * fold.sine - sine * fold.cosine);
        const double beside = (along - fold.along - slant) * shrink;
        const double inward = std::max(over, 0.0);
        // Thicker towards the wall.
        const double thick = 0.5 * fold.thickness + 0.12 * std::clamp(-over, 0.0, 6.0);
        flesh = -smoothMax(-flesh, thick - std::sqrt(beside * beside + inward * inward), 2.5);
    }
    return flesh;
}

double BuiltInAnatomy::polypsAt(const glm::dvec3& p, double along) const {
    double flesh = 30;
    for (const BuiltInPolyp& polyp : mPolyps) {
        if (std::abs(along - polyp.data.along * 1000) > 30) continue;
        const glm::dvec3 q = p - polyp.head;
        const double up = glm::dot(q, polyp.inward), side = glm::length(q - up * polyp.inward);
        // An ellipsoid's distance to first order: value over gradient.
        const double a = side / polyp.across, b = up / polyp.height;
        const double g = std::hypot(a / polyp.across, b / polyp.height);
        const double value = std::sqrt(a * a + b * b);
        const double head = g > 1e-9 ? value * (value - 1) / g : -polyp.height;
        flesh = std::min(flesh, head);
        if (polyp.stalk > 0) {
            const double t = std::clamp(glm::dot(p - polyp.foot, polyp.inward), -3.0, polyp.stalk);
            flesh = smoothMax(flesh * -1, 1.6 - glm::length(p - polyp.foot - t * polyp.inward), 1.5) * -1;
        }
    }
    return flesh;
}

// mm: voxels further from the wall see none of it, so its coarse distance (to 1.5 mm) will do.
constexpr double kFarAway = 6;

// Returns a point between two of the axis: its place by a cubic through them with their tangents, the rest in
// proportion.
AxisPoint BuiltInAnatomy::axisAt(double along) const {
    const int n = std::clamp(static_cast<int>(along), 0, static_cast<int>(mAxis.size()) - 2);
    const AxisPoint &a = mAxis[n], &b = mAxis[n + 1];
    const double t = std::clamp(along - n, 0.0, 1.0), u = 1 - t;
    AxisPoint point;
    point.place = placeBetween(a, b, t);
    point.tangent = u * a.tangent + t * b.tangent;
    point.across = u * a.across + t * b.across;
    point.over = u * a.over + t * b.over;
    point.turn = u * a.turn + t * b.turn;
    point.bend = u * a.bend + t * b.bend;
    point.radius =
        u * u * (1 + 2 * t) * a.radius + t * t * (1 + 2 * u) * b.radius + t * u * (u * a.slope - t * b.slope);
    point.slope = u * a.slope + t * b.slope;
    return point;
}

// Returns where along the axis the ball of its radius is nearest: the wall is the envelope of these balls.
// Newton's method from the nearest point; steps are short, so that what is next to each other stays so.
double BuiltInAnatomy::footOf(const glm::dvec3& p, int nearest) const {
    const int last = static_cast<int>(mAxis.size()) - 1;
    double along = nearest;
    for (int round = 0; round < 3; ++round) {
        const int n = std::min(static_cast<int>(along), last - 1);
        const AxisPoint &a = mAxis[n], &b = mAxis[n + 1];
        const double t = along - n, u = 1 - t;
        const glm::dvec3 to = p - placeBetween(a, b, t);
        const double away = std::max(glm::length(to), 1.0);
        const double ahead = glm::dot(to, u * a.tangent + t * b.tangent) / away;
        const double curve = std::max(1 - glm::dot(to, u * a.bend + t * b.bend) - ahead * ahead, 0.2);
        const double step = (ahead + u * a.slope + t * b.slope) * away / curve;
        along = std::clamp(along + std::clamp(step, -0.7, 0.7), 0.0, static_cast<double>(last));
        if (std::abs(step) < 0.01) break;
    }
    return along;
}

BuiltInAnatomy::Place BuiltInAnatomy::placeOf(const glm::dvec3& p, const int* candidates, int count) const {
    const int near = nearest(p, candidates, count);
    const double coarse = glm::length(p - mAxis[near].place) - mAxis[near].radius;
    if (coarse > kFarAway) return {coarse, static_cast<double>(near)};
    const double along = footOf(p, near);
    const AxisPoint point = axisAt(along);
    const glm::dvec3 to = p - point.place;
    const double d = glm::length(to);
    const double x = glm::dot(to, point.across), y = glm::dot(to, point.over);
    const double flat = std::max(std::hypot(x, y), 1e-9);
    const double c = x / flat, s = y / flat;
    // The taeniae draw the wall in between the sectors: a rounded triangle, 3 % of the radius; none of it
    // where the ends close.
    const double c1 = c * point.turn.x + s * point.turn.y;
    const double triangle = 4 * c1 * c1 * c1 - 3 * c1, share = std::min(flat / (0.8 * point.radius), 1.0);
    const double radius = point.radius * (1 + 0.035 * triangle * share * share * (3 - 2 * share));
    double wall = d - radius;
    if (wall > -8) wall += unevenness(p);
    wall = smoothMax(wall, -foldsAt(point, along, to, c, s, radius), 3.0);
    wall = smoothMax(wall, -polypsAt(p, along), 1.2);
    return {wall, along};
}

void BuiltInAnatomy::addPolyp(double along, double angle, PolypShape shape, double diameter) {
    const AxisPoint& point = mAxis[static_cast<int>(along)];
    const glm::dvec3 outward = std::cos(angle) * point.across + std::sin(angle) * point.over;
    // To the wall (or a fold's flank) by halving.
    double in = 2, out = point.radius + 6;
    for (int n = 0; n < 30; ++n) {
        const double mid = 0.5 * (in + out);
        (placeOf(point.place + mid * outward).wall < 0 ? in : out) = mid;
    }
    BuiltInPolyp polyp;
    polyp.inward = -outward;
    polyp.foot = point.place + in * outward;
    polyp.across = 0.5 * diameter;
    polyp.height = shape == PolypShape::Flat ? std::min(0.22 * diameter, 1.8) : 0.5 * diameter;
    polyp.stalk = shape == PolypShape::Pedunculated ? 0.5 * diameter + 2 : 0.0;
    const double lift = shape == PolypShape::Pedunculated ? polyp.stalk
                        : shape == PolypShape::Sessile    ? 0.15 * diameter
                                                          : 0.4;
    polyp.head = polyp.foot + lift * polyp.inward;
    polyp.data = {polyp.head * 0.001, diameter * 0.001, shape, along * 0.001};
    mPolyps.push_back(polyp);
}

void BuiltInAnatomy::makePolyps(std::uint64_t seed) {
    using enum PolypShape;
    constexpr struct {
        double share, diameter;
        PolypShape shape;
    } kPolyps[] = {{0.035, 6, Sessile},     {0.12, 10, Pedunculated}, {0.20, 5, Sessile}, {0.29, 9, Flat},
                   {0.38, 8, Sessile},      {0.49, 12, Pedunculated}, {0.57, 7, Flat},    {0.66, 4, Sessile},
                   {0.76, 8, Pedunculated}, {0.86, 12, Flat},         {0.95, 10, Sessile}};
    int n = 0;
    for (const auto& wanted : kPolyps) {
        double along = (wanted.share + between(-0.01, 0.01, unitNumber(seed, 20, n))) * unbentLength();
        const double angle = 2 * kPi * unitNumber(seed, 21, n);
        // Away from the crests of folds, so that it sits on the wall.
        for (int tries = 0; tries < 24; ++tries, along += 1) {
            bool clear = true;
            for (const Fold& fold : mFolds)
                clear = clear && (std::abs(fold.unbent - along) > 3 + 0.5 * wanted.diameter ||
                                  std::cos(angle) * fold.cosine + std::sin(angle) * fold.sine < 0.35);
            if (clear) break;
        }
        addPolyp(std::clamp(bentAlong(along), 10.0, length() - 5), angle, wanted.shape, wanted.diameter);
        ++n;
    }
}

}  // namespace stereonav
