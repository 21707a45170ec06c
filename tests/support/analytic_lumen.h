// Lumens whose distance to the wall is known in closed form, with their centrelines. Metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "colon/flight/colon_flight.h"

namespace stereonav {

struct AnalyticLumen {
    std::string name;
    std::function<double(const glm::dvec3&)> distance;  // distance to the wall; <= 0 inside it
    Centreline line;
    Pose home;

    FreeDistance freeDistance() const {
        return [d = distance](const glm::dvec3& p, double upTo) { return std::clamp(d(p), 0.0, upTo); };
    }
};

// Returns a pose that looks along `forward`, with the head as upright as possible.
inline Pose lookingAlong(const glm::dvec3& position, const glm::dvec3& forward) {
    const double pitch = std::asin(std::clamp(forward.z, -1.0, 1.0));
    return poseFromAngles(position, std::atan2(forward.x, forward.y), pitch, 0);
}

// Returns points every `spacing` metres along straight lines between corners.
inline Centreline lineThrough(const std::vector<glm::dvec3>& corners, double radius, double spacing = 0.001,
                              int segment = 1) {
    Centreline line;
    line.points.push_back({corners.front(), radius, segment});
    for (std::size_t k = 1; k < corners.size(); ++k) {
        const double length = glm::distance(corners[k - 1], corners[k]);
        const int pieces = std::max(1, static_cast<int>(std::lround(length / spacing)));
        for (int i = 1; i <= pieces; ++i)
            line.points.push_back(
                {glm::mix(corners[k - 1], corners[k], static_cast<double>(i) / pieces), radius, segment});
    }
    return line;
}

inline double distanceToPiece(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 way = b - a;
    const double t = std::clamp(glm::dot(p - a, way) / std::max(glm::dot(way, way), 1e-300), 0.0, 1.0);
    return glm::distance(p, a + t * way);
}

// Returns everything within `radius` of straight pieces. The distance is exact beside straight tubes; inside
// corners, where balls overlap, it is below the true one, as a free distance may be.
inline AnalyticLumen tubeAlong(const std::string& name, const std::vector<glm::dvec3>& corners,
                               double radius) {
    AnalyticLumen lumen;
    lumen.name = name;
    lumen.distance = [corners, radius](const glm::dvec3& p) {
        double nearest = 1e9;
        for (std::size_t k = 1; k < corners.size(); ++k)
            nearest = std::min(nearest, distanceToPiece(p, corners[k - 1], corners[k]));
        return radius - nearest;
    };
    lumen.line = lineThrough(corners, radius);
    lumen.home = lookingAlong(corners[0], glm::normalize(corners[1] - corners[0]));
    return lumen;
}

inline AnalyticLumen straightTube(double radius = 0.02, double length = 0.3) {
    return tubeAlong("straight tube", {{0, 0, 0}, {0, length, 0}}, radius);
}

// Returns nine tenths of a torus in the plane z = 0.
inline AnalyticLumen torus(double large = 0.05, double small = 0.015) {
    AnalyticLumen lumen;
    lumen.name = "torus";
    lumen.distance = [large, small](const glm::dvec3& p) {
        return small - std::hypot(std::hypot(p.x, p.y) - large, p.z);
    };
    std::vector<glm::dvec3> corners;
    const int pieces = static_cast<int>(large * 1.8 * std::numbers::pi / 0.001);
    for (int k = 0; k <= pieces; ++k) {
        const double angle = 1.8 * std::numbers::pi * k / pieces;
        corners.push_back({large * std::cos(angle), large * std::sin(angle), 0});
    }
    lumen.line = lineThrough(corners, small);
    lumen.home = lookingAlong(corners.front(), {0, 1, 0});
    return lumen;
}

// Returns a tube with thin folds across it, each with a round opening, alternately off the axis.
inline AnalyticLumen foldedTube(double radius = 0.02, double opening = 0.006) {
    AnalyticLumen lumen = straightTube(radius, 0.2);
    lumen.name = "tube with narrow folds";
    lumen.distance = [tube = lumen.distance, opening](const glm::dvec3& p) {
        double nearest = tube(p);
        for (int fold = 0; fold < 4; ++fold) {
            const double across = std::hypot(p.x - (fold % 2 ? 0.002 : -0.002), p.z);
            nearest =
                std::min(nearest, std::hypot(p.y - (0.04 + 0.04 * fold), std::max(opening - across, 0.0)));
        }
        return nearest;
    };
    return lumen;
}

// Returns a hairpin: legs with a wall of a millimetre between them, and a bend too tight to see around.
inline AnalyticLumen flexure(double radius = 0.012) {
    const double apart = 2 * radius + 0.001;
    return tubeAlong("tight flexure", {{0, 0, 0}, {0, 0.1, 0}, {apart, 0.1, 0}, {apart, 0, 0}}, radius);
}

// Returns a tube that narrows smoothly to `least` half way. Its slope makes the plain distance too large, so
// it is divided by it.
inline AnalyticLumen throat(double least, double radius = 0.015, double length = 0.16) {
    AnalyticLumen lumen = straightTube(radius, length);
    lumen.name = "throat";
    lumen.distance = [least, radius, length](const glm::dvec3& p) {
        const double t = (p.y - length / 2) / 0.02;
        const double wall = radius - (radius - least) * std::exp(-t * t);
        // The wall's slope is at most 0.86 (radius - least) / 0.02.
        const double slope = 0.86 * (radius - least) / 0.02;
        const double ends = radius + std::min(p.y, 0.0) - std::max(p.y - length, 0.0);
        return std::min((wall - std::hypot(p.x, p.z)) / std::sqrt(1 + slope * slope), ends);
    };
    return lumen;
}

// Returns two tubes with tissue between their ends.
inline AnalyticLumen interrupted(double radius = 0.012) {
    AnalyticLumen lumen;
    lumen.name = "two segments";
    const std::vector<glm::dvec3> a{{0, 0, 0}, {0, 0.08, 0}}, b{{0.02, 0.12, 0.01}, {0.02, 0.2, 0.03}};
    const AnalyticLumen first = tubeAlong("", a, radius), second = tubeAlong("", b, radius);
    lumen.distance = [f = first.distance, s = second.distance](const glm::dvec3& p) {
        return std::max(f(p), s(p));
    };
    lumen.line = first.line;
    for (CentrelinePoint point : second.line.points) {
        point.segment = 2;
        lumen.line.points.push_back(point);
    }
    lumen.home = first.home;
    return lumen;
}

}  // namespace stereonav
