// Rounds of two steps: each point moves to the middle of the lumen in the plane across the line, then the
// line is smoothed over a length that follows the radius, so that it does not swing into every bulge.
// Smoothing with a kernel G draws bends inwards by about (length)^2 * curvature; applied as 2 G - G G it
// leaves arcs where they are up to the fourth order. Each move is taken only as far as the line stays inside.
#include "colon/centreline/centreline_refine.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

using Points = std::vector<glm::dvec3>;

constexpr int kRounds = 12;
constexpr double kSmoothing = 0.6;   // standard deviation of G, in radii
constexpr double kKeptRadius = 0.7;  // smoothing may take this share of the radius in the middle
// At the end the line is smoothed alone, over a shorter length: points that were held back, each by its own
// share, stand out from the others.
constexpr int kPolishing = 3;
constexpr double kPolish = 0.3, kPolishKept = 0.5;
constexpr double kMostCut = 0.125;  // share of the length that is cut from each end, twice
constexpr double kMostWorkPoints = 100000;
constexpr int kChunk = 64;  // points of a parallel task

void forChunks(std::size_t count, const std::function<void(std::size_t)>& body) {
    parallelFor(static_cast<int>((count + kChunk - 1) / kChunk), [&](int chunk) {
        const std::size_t end = std::min<std::size_t>(count, (chunk + 1) * std::size_t(kChunk));
        for (std::size_t i = chunk * std::size_t(kChunk); i < end; ++i) body(i);
    });
}

std::vector<double> arcLengths(const Points& points) {
    std::vector<double> at(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i)
        at[i] = at[i - 1] + glm::length(points[i] - points[i - 1]);
    return at;
}

// How many points to cut from the start: up to where distance - length / 2 is greatest. From the bottom of
// a round end the distance grows as the length does, from the corner of a flat end 0.58 to 0.71 as fast.
std::size_t startOf(const LumenProbe& probe, const Points& points) {
    double along = 0, best = -INFINITY;
    std::size_t start = 0;
    const double most = kMostCut * polylineLength(points);
    for (std::size_t i = 0; i < points.size() && along <= most; ++i) {
        if (const double gain = probe.distance(points[i]) - 0.5 * along; gain > best) {
            best = gain;
            start = i;
        }
        if (i + 1 < points.size()) along += glm::length(points[i + 1] - points[i]);
    }
    return start;
}

Points withoutEnds(const LumenProbe& probe, const Points& points) {
    const std::size_t head = startOf(probe, points);
    const std::size_t tail = startOf(probe, Points(points.rbegin(), points.rend()));
    if (head + tail >= points.size()) return points;
    return Points(points.begin() + head, points.end() - tail);
}

glm::dvec3 tangentAt(const Points& points, std::size_t i, std::size_t reach) {
    const std::size_t last = points.size() - 1;
    const glm::dvec3 along = points[std::min(i + reach, last)] - points[i > reach ? i - reach : 0];
    const double length = glm::length(along);
    return length > 0 ? along / length : glm::dvec3(0.0);
}

// The point moved towards the middle across the tangent. Central differences over half the distance to the
// wall: between two parallel walls, and in a round tube, the step leads to the middle itself.
glm::dvec3 centred(const LumenProbe& probe, const glm::dvec3& point, const glm::dvec3& tangent) {
    if (tangent == glm::dvec3(0.0)) return point;
    const double reach = std::max(probe.smallestSpacing(), 0.5 * probe.distance(point));
    const glm::dvec3 aside = std::abs(tangent.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(tangent, aside)), v = glm::cross(tangent, u);
    glm::dvec3 move(0.0);
    for (const glm::dvec3& axis : {u, v})
        move += 0.5 * (probe.distance(point + reach * axis) - probe.distance(point - reach * axis)) * axis;
    const glm::dvec3 target = point + move;
    return probe.inside(target) ? target : point;
}

Points centredAll(const LumenProbe& probe, const Points& points, double spacing) {
    Points moved(points.size());
    forChunks(points.size(), [&](std::size_t i) {
        const double reach = std::clamp(0.5 * probe.distance(points[i]) / spacing, 1.0, 20.0);
        const glm::dvec3 tangent = tangentAt(points, i, static_cast<std::size_t>(reach));
        moved[i] = centred(probe, centred(probe, points[i], tangent), tangent);
    });
    return moved;
}

// Continuation of a sequence beyond its ends.
enum class Beyond {
    Turned,    // turned about the end: ends of a line and their directions stay where they are
    Mirrored,  // for displacements: the ends are smoothed like the rest
};

glm::dvec3 valueBeyond(const Points& values, std::ptrdiff_t i, Beyond beyond) {
    const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
    if (i >= 0 && i <= last) return values[i];
    const std::ptrdiff_t inner = std::clamp<std::ptrdiff_t>(i < 0 ? -i : 2 * last - i, 0, last);
    if (beyond == Beyond::Mirrored) return values[inner];
    return 2.0 * (i < 0 ? values.front() : values.back()) - values[inner];
}

// sigmas: standard deviations in points.
Points gaussian(const Points& values, const std::vector<double>& sigmas, Beyond beyond) {
    Points smooth(values.size());
    forChunks(values.size(), [&](std::size_t i) {
        const double sigma = sigmas[i];
        const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3 * sigma));
        const auto at = static_cast<std::ptrdiff_t>(i);
        glm::dvec3 sum = values[i];
        double weights = 1;
        for (std::ptrdiff_t n = 1; n <= reach; ++n) {
            const double w = std::exp(-0.5 * (n / sigma) * (n / sigma));
            sum += w * (valueBeyond(values, at - n, beyond) + valueBeyond(values, at + n, beyond));
            weights += 2 * w;
        }
        smooth[i] = sum / weights;
    });
    return smooth;
}

Points sharpened(const Points& values, const std::vector<double>& sigmas, Beyond beyond) {
    Points smooth = gaussian(values, sigmas, beyond);
    const Points twice = gaussian(smooth, sigmas, beyond);
    for (std::size_t i = 0; i < values.size(); ++i) smooth[i] = 2.0 * smooth[i] - twice[i];
    return smooth;
}

// Standard deviations in points: a share of the radius, itself evened along the line, for a sudden change of
// the kernel would leave a kink. Shorter towards the ends, so that they find the middle too.
std::vector<double> smoothingAlong(const LumenProbe& probe, const Points& middle, double share,
                                   double spacing) {
    Points radii(middle.size());
    for (std::size_t i = 0; i < middle.size(); ++i) radii[i].x = probe.distance(middle[i]);
    radii = gaussian(radii, std::vector<double>(middle.size(), 5.0), Beyond::Mirrored);
    std::vector<double> sigmas(middle.size());
    for (std::size_t i = 0; i < middle.size(); ++i) {
        const double most = 1.0 + 0.5 * static_cast<double>(std::min(i, middle.size() - 1 - i));
        sigmas[i] = std::clamp(share * radii[i].x / spacing, 1.0, most);
    }
    return sigmas;
}

// The points moved to the middle, and smoothed: the line with its ends held, and the moves as they are.
Points smoothed(const LumenProbe& probe, const Points& points, const Points& middle, double spacing) {
    const std::vector<double> sigmas = smoothingAlong(probe, middle, kSmoothing, spacing);
    Points moves(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) moves[i] = middle[i] - points[i];
    Points smooth = sharpened(points, sigmas, Beyond::Turned);
    moves = sharpened(moves, sigmas, Beyond::Mirrored);
    for (std::size_t i = 0; i < points.size(); ++i) smooth[i] += moves[i];
    return smooth;
}

// Moves the points towards `targets` one after the other, each as far as both lines that end in it stay
// inside.
// kept: the share of the distance to the wall at `middle` that must be left, unless less was there before.
void moveInside(const LumenProbe& probe, Points& points, const Points& targets, const Points& middle,
                double kept) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double enough = std::min(probe.distance(points[i]), kept * probe.distance(middle[i]));
        for (const double share : {1.0, 0.5, 0.25}) {
            const glm::dvec3 to = glm::mix(points[i], targets[i], share);
            if (!(probe.distance(to) >= enough)) continue;
            if (i > 0 && !probe.lineInside(points[i - 1], to)) continue;
            if (i + 1 < points.size() && !probe.lineInside(to, points[i + 1])) continue;
            if (!probe.inside(to)) continue;
            points[i] = to;
            break;
        }
    }
}

bool allInside(const LumenProbe& probe, const Points& points) {
    for (std::size_t i = 1; i < points.size(); ++i)
        if (!probe.lineInside(points[i - 1], points[i])) return false;
    return true;
}

// Returns the points resampled, unless the line would leave the lumen where it cuts a corner.
Points evened(const LumenProbe& probe, const Points& points, double spacing) {
    Points even = resampleEvenly(probe, points, spacing);
    return allInside(probe, even) ? even : points;
}

}  // namespace

double polylineLength(const Points& points) {
    return arcLengths(points).empty() ? 0.0 : arcLengths(points).back();
}

Points resampleEvenly(const LumenProbe& probe, const Points& points, double spacing) {
    const std::vector<double> at = arcLengths(points);
    if (points.size() < 2 || !(at.back() > 0))
        return Points(points.begin(), points.begin() + !points.empty());
    const double steps = std::max(1.0, std::round(at.back() / spacing));
    if (!(steps <= 1e7))
        throw Error("", "", "the centreline would have more than ten million points", "use a wider spacing");
    const auto count = static_cast<std::size_t>(steps);
    Points even(count + 1, points.front());
    even[count] = points.back();
    std::size_t k = 1;
    for (std::size_t n = 1; n < count; ++n) {
        const double s = at.back() * static_cast<double>(n) / steps;
        while (k + 1 < points.size() && at[k] < s) ++k;
        const double span = at[k] - at[k - 1];
        const double share = span > 0 ? std::clamp((s - at[k - 1]) / span, 0.0, 1.0) : 0.0;
        even[n] = glm::mix(points[k - 1], points[k], share);
        if (!probe.inside(even[n])) even[n] = share < 0.5 ? points[k - 1] : points[k];
    }
    return even;
}

Points refineCentreline(const LumenProbe& probe, const Points& rough, const std::function<void()>& poll) {
    Points points = withoutEnds(probe, rough);  // cut again once the line is smooth
    const double length = polylineLength(points);
    if (points.size() < 3 || !(length > 0)) return points;
    const double spacing = std::max(probe.smallestSpacing(), length / kMostWorkPoints);
    points = evened(probe, points, spacing);
    for (int round = 0; round < kRounds; ++round) {
        poll();
        const Points middle = centredAll(probe, points, spacing);
        moveInside(probe, points, smoothed(probe, points, middle, spacing), middle, kKeptRadius);
        if (round == kRounds / 2) points = withoutEnds(probe, points);
        points = evened(probe, points, spacing);
    }
    for (int round = 0; round < kPolishing; ++round) {
        const Points middle = points;
        const std::vector<double> sigmas = smoothingAlong(probe, middle, kPolish, spacing);
        moveInside(probe, points, sharpened(middle, sigmas, Beyond::Turned), middle, kPolishKept);
        points = evened(probe, points, spacing);
    }
    return points;
}

}  // namespace stereonav
