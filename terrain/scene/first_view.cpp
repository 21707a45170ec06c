#include "terrain/scene/first_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/math/constants.h"
#include "terrain/light/sun_and_sky.h"
#include "terrain/scene/ground_sketch.h"

namespace stereonav {
namespace {

constexpr double kAspect = 16.0 / 9;
constexpr int kColumns = 25;          // columns of the picture in which the ground is looked at
constexpr double kFirstWay = 0.01;    // shares of the extent: where a column begins
constexpr double kWayGrows = 1.06;    // from a place of a column to the next
constexpr double kSkyWished = 0.3;    // share of the picture
constexpr double kTopWished = 0.84;   // highest place of the summit, as a share of half the height
constexpr double kEyesWithin = 0.96;  // share of the half extents within which eyes stay
constexpr double kLeastAbove = 0.03;  // shares of the half extents above all ground as near as that
constexpr double kSteepest = 1.2;     // radians, of the view

// A piece of ground that is seen: between two heights of the picture (-1 to 1), at a distance.
struct SeenPiece {
    double low, high, way;
    glm::vec2 gradient;
};

// What a picture shows of the ground.
struct SeenGround {
    std::vector<SeenPiece> pieces;
    double pitch = 0;           // radians upwards
    double below = 0;           // share of the picture: sky beneath the horizon, beyond the ground's end
    double sky = 1, empty = 0;  // shares of the picture: above the ground, and where it should be
    double nearest = 0;         // metres forward, of what is seen lowest
    double silhouette = 0;      // height of the skyline's top above its low parts, shares of the picture
    double width = 0;           // share of columns that the heights fill
    double ridges = 0;          // that hide what lies behind them, a column
    double nearSkyline = 0;     // share of columns whose skyline is near
};

// The places of one column: where they appear and what is hidden.
struct SeenColumn {
    std::vector<SeenPiece> pieces;  // heights as tangents of level views
    double top = -kInfinity, topWay = 0;
    int ridges = 0;
};

struct SketchEye {
    const GroundSketch& ground;
    glm::dvec3 position;
    double heading;     // radians
    double halfHeight;  // tangent of half the vertical field of view

    glm::dvec2 forward() const { return {std::sin(heading), std::cos(heading)}; }
    SeenColumn column(int k) const;
};

SeenColumn SketchEye::column(int k) const {
    SeenColumn seen;
    const double aside = kAspect * halfHeight * (2.0 * k / (kColumns - 1) - 1);
    const glm::dvec2 ahead = forward(), way = ahead + aside * glm::dvec2(ahead.y, -ahead.x);
    const double extent = glm::length(ground.half());
    bool hidden = true, open = true;  // before the first ground
    for (double t = kFirstWay * extent; t < 2.5 * extent; t *= kWayGrows) {
        const GroundSketch::At at = ground.at(glm::dvec2(position) + t * way);
        if (!std::isfinite(at.height)) {
            open = true;
            continue;
        }
        const double tangent = (at.height - position.z) / t;
        if (tangent > seen.top) {
            if (!open && seen.top > -kInfinity)
                seen.pieces.push_back({seen.top, tangent, t, glm::vec2(at.gradient)});
            if (hidden && !open && seen.top > -kInfinity && t > 1.15 * seen.topWay) ++seen.ridges;
            seen.top = tangent;
            seen.topWay = t;
            hidden = false;
        } else {
            hidden = true;
        }
        open = false;
    }
    return seen;
}

// Returns the pitch that leaves the wished share of the sky above a skyline, and its top in the picture.
double pitchFor(const std::vector<double>& skyline, double halfHeight) {
    if (skyline.empty()) return 0;
    double sum = 0;
    for (const double tangent : skyline) sum += std::atan(tangent);
    const double mean = sum / static_cast<double>(skyline.size()),
                 top = std::atan(*std::max_element(skyline.begin(), skyline.end()));
    const double pitch = std::max(mean - std::atan((1 - 2 * kSkyWished) * halfHeight),
                                  top - std::atan(kTopWished * halfHeight));
    return std::clamp(pitch, -kSteepest, kSteepest);
}

// pitch: null to choose it.
SeenGround lookFrom(const SketchEye& eye, double targetWay, const double* pitch) {
    SeenGround seen;
    std::array<SeenColumn, kColumns> columns;
    std::vector<double> skyline;
    for (int k = 0; k < kColumns; ++k) {
        columns[k] = eye.column(k);
        if (columns[k].top > -kInfinity) skyline.push_back(columns[k].top);
    }
    seen.pitch = pitch ? *pitch : pitchFor(skyline, eye.halfHeight);
    const double down = std::tan(seen.pitch);
    const auto inPicture = [&](double tangent) {
        const double depth = 1 + tangent * down;
        const double v = depth > 1e-6 ? (tangent - down) / depth / eye.halfHeight : tangent < down ? -1 : 1;
        return std::clamp(v, -1.0, 1.0);
    };
    if (skyline.empty()) {
        seen.empty = 1;
        return seen;
    }
    std::vector<double> sorted = skyline;
    std::sort(sorted.begin(), sorted.end());
    const double low = inPicture(sorted[sorted.size() / 6]), top = inPicture(sorted.back());
    double ground = 0, above = 0, below = 0, filled = 0, near = 0, ridges = 0;
    seen.nearest = kInfinity;
    for (const SeenColumn& column : columns) {
        bool first = true;
        for (const SeenPiece& piece : column.pieces) {
            const double a = inPicture(piece.low), b = inPicture(piece.high);
            if (!(b > a)) continue;
            if (first) seen.nearest = std::min(seen.nearest, double(piece.way));
            first = false;
            ground += b - a;
            seen.pieces.push_back({a, b, piece.way, piece.gradient});
        }
        const double line = column.top > -kInfinity ? inPicture(column.top) : -1;
        above += 1 - line;
        below += std::max(0.0, inPicture(0) - line);
        filled += line > low + 0.15 * (top - low);
        near += column.topWay < 0.35 * targetWay;
        ridges += column.ridges;
    }
    seen.sky = above / (2 * kColumns);
    seen.below = below / (2 * kColumns);
    seen.empty = std::max(0.0, 1 - seen.sky - ground / (2 * kColumns));
    seen.silhouette = 0.5 * (top - low);
    seen.width = filled / kColumns;
    seen.ridges = ridges / kColumns;
    seen.nearSkyline = near / kColumns;
    return seen;
}

// Mean and spread of sunlight on what is seen, by its share of the picture, and the share that is turned
// away.
struct SeenLightOf {
    double mean = 0, spread = 0, dark = 0;
};
SeenLightOf lightOn(const std::vector<SeenPiece>& pieces, double azimuth, double elevation) {
    const glm::dvec3 sun = directionToSun(azimuth, elevation);
    double weights = 0, sum = 0, squares = 0, dark = 0;
    for (const SeenPiece& piece : pieces) {
        const double weight = piece.high - piece.low;
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(-double(piece.gradient.x), -double(piece.gradient.y), 1.0));
        const double light = std::max(0.0, glm::dot(normal, sun));
        weights += weight;
        sum += weight * light;
        squares += weight * light * light;
        if (light <= 0.05) dark += weight;
    }
    if (!(weights > 0)) return {};
    SeenLightOf seen;
    seen.mean = sum / weights;
    seen.spread = std::sqrt(std::max(0.0, squares / weights - seen.mean * seen.mean));
    seen.dark = dark / weights;
    return seen;
}

// How well relief shows in a light: its spread, less where much of it is turned away from the sun.
double reliefShown(const SeenLightOf& light) {
    return light.spread - 0.3 * std::max(0.0, light.dark - 0.15);
}

double steepnessOf(const std::vector<SeenPiece>& pieces) {
    double weights = 0, sum = 0;
    for (const SeenPiece& piece : pieces) {
        const double weight = piece.high - piece.low;
        weights += weight;
        sum += weight * std::min(10.0, double(glm::length(piece.gradient)));
    }
    return weights > 0 ? sum / weights : 0;
}

// Sets the sun: 80 to 110 degrees aside of the view, 25 to 35 degrees high, higher over steep ground, which
// would be dark.
void setSun(const std::vector<SeenPiece>& pieces, double heading, FirstView& view) {
    constexpr double kAside[] = {-95, 95, -80, 80, -110, 110};
    view.sunElevation = (25 + 10 * std::min(1.0, steepnessOf(pieces) / 0.5)) * kRadians;
    double best = -kInfinity;
    for (const double aside : kAside) {
        const double azimuth = heading + aside * kRadians;
        const double shown = reliefShown(lightOn(pieces, azimuth, view.sunElevation));
        if (shown <= best + 1e-6) continue;
        best = shown;
        view.sunAzimuth = azimuth - 2 * kPi * std::floor(azimuth / (2 * kPi));
    }
}

// Grows from 0 at `from` to 1 at `to`, which may lie below.
double grown(double value, double from, double to) {
    return std::clamp((value - from) / (to - from), 0.0, 1.0);
}
// Is 1 between two values and falls to 0 within a way on each side.
double plateau(double value, double low, double high, double way) {
    return value < low ? grown(value, low - way, low) : grown(value, high + way, high);
}

// Weights and limits were set by looking: at the first views of four elevation models, of single mountains
// and of ranges.
double scoreOf(const SeenGround& seen, double heading, double targetWay, double extent) {
    constexpr double kUsualSun = 30 * kRadians, kAside = 95 * kRadians;
    if (seen.pieces.empty()) return -kInfinity;  // worse than any that shows some ground
    const double relief = std::max(reliefShown(lightOn(seen.pieces, heading - kAside, kUsualSun)),
                                   reliefShown(lightOn(seen.pieces, heading + kAside, kUsualSun)));
    return 1.0 * plateau(seen.sky, 0.2, 0.4, 0.2) + 1.2 * grown(seen.nearest / targetWay, 0.03, 0.2) -
           3.0 * seen.empty - 9.0 * seen.below + 1.2 * std::min(1.0, seen.silhouette / 0.22) +
           1.0 * std::min(1.0, relief / 0.22) + 0.8 * std::min(1.0, seen.ridges / 3) +
           1.0 * plateau(seen.width, 0.7, 0.85, 0.5) - 1.0 * seen.nearSkyline +
           0.9 * grown(targetWay / extent, 0.3, 1.0);
}

struct Candidate {
    glm::dvec3 position;
    double heading, targetWay;
};

// Distance from a place along a direction to the rectangle in which eyes stay.
double wayInside(const GroundSketch& ground, const glm::dvec2& from, const glm::dvec2& direction) {
    double way = kInfinity;
    for (int k = 0; k < 2; ++k)
        if (direction[k] != 0)
            way = std::min(
                way, (std::copysign(kEyesWithin * ground.half()[k], direction[k]) - from[k]) / direction[k]);
    return std::max(way, 0.0);
}

std::vector<Candidate> candidatesOver(const GroundSketch& ground, double clearance) {
    constexpr int kAzimuths = 24;
    constexpr double kWays[] = {1, 0.75, 0.5}, kDepressions[] = {2, 6, 11, 18};  // degrees
    const glm::dvec2 half = ground.half();
    const double around = kLeastAbove * glm::length(half);
    const glm::dvec2 limit = kEyesWithin * half;
    const glm::dvec2 targets[] = {glm::clamp(ground.summit(), -0.8 * half, 0.8 * half), glm::dvec2(0.0)};
    std::vector<Candidate> candidates;
    for (const glm::dvec2& target : targets)
        for (int a = 0; a < kAzimuths; ++a) {
            const double angle = 2 * kPi * a / kAzimuths;
            const glm::dvec2 away(-std::sin(angle), -std::cos(angle));
            const double most = wayInside(ground, target, away);
            for (const double share : kWays) {
                const double way = share * most;
                // Too near to be looked at from a side.
                if (!(way > 0.3 * std::min(half.x, half.y))) continue;
                const glm::dvec2 place = glm::clamp(target + way * away, -limit, limit);
                const double least = ground.highestAround(place, around) + std::max(clearance, around);
                double before = -kInfinity;
                for (const double depression : kDepressions) {
                    const double z =
                        std::max(least, ground.usualHeight() + way * std::tan(depression * kRadians));
                    if (z > before) candidates.push_back({{place, z}, angle, way});
                    before = z;
                }
            }
        }
    return candidates;
}

// The highest sample within a distance of a place, or NaN.
double highestNear(const Heightfield& ground, const glm::dvec2& place, const glm::dvec2& distance) {
    const auto inside = [](double g, int samples) {
        return static_cast<int>(std::clamp(g, 0.0, samples - 1.0));
    };
    const glm::dvec2 low = ground.gridFromWorld(place - distance),
                     high = ground.gridFromWorld(place + distance);
    double highest = std::nan("");
    for (int j = inside(std::floor(low.y), ground.height()); j <= inside(std::ceil(high.y), ground.height());
         ++j)
        for (int i = inside(std::floor(low.x), ground.width());
             i <= inside(std::ceil(high.x), ground.width()); ++i)
            if (std::isfinite(ground.sample(i, j)))
                highest = std::isnan(highest) ? ground.sample(i, j)
                                              : std::max(highest, double(ground.sample(i, j)));
    return highest;
}

}  // namespace

FirstView chooseFirstView(const Heightfield& ground, double clearance, double verticalFov) {
    const GroundSketch coarse(ground);
    const double halfHeight = std::tan(0.5 * verticalFov);
    std::vector<Candidate> candidates = candidatesOver(coarse, clearance);
    const int count = static_cast<int>(candidates.size());
    std::vector<double> scores(candidates.size());
    parallelFor(count, [&](int k) {
        const Candidate& c = candidates[k];
        scores[k] = scoreOf(lookFrom({coarse, c.position, c.heading, halfHeight}, c.targetWay, nullptr),
                            c.heading, c.targetWay, glm::length(coarse.half()));
    });
    Candidate best = candidates[std::max_element(scores.begin(), scores.end()) - scores.begin()];
    // The coarse copy does not know all samples.
    const double highest = highestNear(ground, glm::dvec2(best.position),
                                       glm::dvec2(0.3 * kLeastAbove * glm::length(coarse.half())));
    if (std::isfinite(highest))
        best.position.z = std::max(
            best.position.z, highest + std::max(clearance, 0.5 * kLeastAbove * glm::length(coarse.half())));
    const SeenGround seen =
        lookFrom({coarse, best.position, best.heading, halfHeight}, best.targetWay, nullptr);
    FirstView view;
    view.pose = poseFromAngles(best.position, best.heading, seen.pitch, 0.0);
    setSun(seen.pieces, best.heading, view);
    return view;
}

FirstView chooseSun(const Heightfield& ground, const Pose& pose, double verticalFov) {
    const GroundSketch coarse(ground);
    const PoseAngles angles = anglesOf(pose);
    const double pitch = std::clamp(angles.pitch, -kSteepest, kSteepest);
    FirstView view;
    view.pose = pose;
    setSun(lookFrom({coarse, pose.position, angles.heading, std::tan(0.5 * verticalFov)},
                    glm::length(coarse.half()), &pitch)
               .pieces,
           angles.heading, view);
    return view;
}

}  // namespace stereonav
