#include "tests/oracle/late_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

namespace stereonav {
namespace {

constexpr double kStep = 0.25;     // pixels
constexpr double kJump = 1.5;      // pixels between two steps: more is no surface
constexpr double kSurface = 0.03;  // relative: inverse depths of one surface beside each other
constexpr double kFront = 1.1;     // times a neighbour's depth: farther pixels beside it move with it
constexpr int kMostSteps = 20'000;

struct Seen {
    const Plane<PackedColor>& color;
    Plane<double> inverse;
    double nearest = 0;
};

double inverseWithFront(const Plane<float>& depth, int x, int y) {
    constexpr int kBeside[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const double here = depth.at(x, y);
    double front = here;
    for (const auto& [dx, dy] : kBeside) {
        const int u = x + dx, v = y + dy;
        if (u < 0 || v < 0 || u >= depth.width() || v >= depth.height()) continue;
        if (depth.at(u, v) > 0) front = std::min(front, static_cast<double>(depth.at(u, v)));
    }
    return 1 / (here > front * kFront ? front : here);
}

double knownInverse(const Plane<float>& depth, int x, int y) {
    const auto known = [&](int at) { return depth.at(at, y) > 0; };
    if (known(x)) return inverseWithFront(depth, x, y);
    int left = x, right = x;
    while (left >= 0 && !known(left)) --left;
    while (right < depth.width() && !known(right)) ++right;
    double inverse = 1e300;
    if (left >= 0) inverse = std::min(inverse, inverseWithFront(depth, left, y));
    if (right < depth.width()) inverse = std::min(inverse, inverseWithFront(depth, right, y));
    return inverse < 1e300 ? inverse : 0;
}

double inverseAt(const Seen& seen, const glm::dvec2& place) {
    const int x = static_cast<int>(std::clamp(place.x, 0.0, seen.inverse.width() - 0.5));
    const int y = static_cast<int>(std::clamp(place.y, 0.0, seen.inverse.height() - 0.5));
    return seen.inverse.at(x, y);
}

PackedColor colorOf(const Seen& seen, const glm::dvec2& place, double inverse, double reach) {
    const double u = std::clamp(place.x - 0.5, 0.0, seen.color.width() - 1.0),
                 v = std::clamp(place.y - 0.5, 0.0, seen.color.height() - 1.0);
    const int x = std::min(static_cast<int>(u), std::max(seen.color.width() - 2, 0)),
              y = std::min(static_cast<int>(v), std::max(seen.color.height() - 2, 0));
    const double right = u - x, down = v - y;
    std::array<double, 3> surface{}, all{};
    double weight = 0;
    for (int n = 0; n < 4; ++n) {
        const int px = std::min(x + n % 2, seen.color.width() - 1),
                  py = std::min(y + n / 2, seen.color.height() - 1);
        const double share = (n % 2 ? right : 1 - right) * (n / 2 ? down : 1 - down);
        const bool same = std::abs(seen.inverse.at(px, py) - inverse) <= reach;
        weight += same ? share : 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double value = seen.color.at(px, py) >> (10 * k) & 1023u;
            all[k] += share * value;
            if (same) surface[k] += share * value;
        }
    }
    PackedColor color = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double value = weight > 1e-4 ? surface[k] / weight : all[k];
        color |= static_cast<PackedColor>(std::lround(value)) << (10 * k);
    }
    return color;
}

struct Ray {
    glm::dvec2 infinite, shift;
    glm::dvec2 at(double inverse) const { return infinite + inverse * shift; }
};

struct Met {
    double inverse = 0;
    bool uncovered = false;
};

Met follow(const Seen& seen, const Ray& ray, double nearest) {
    const double way = nearest * glm::length(ray.shift);
    const int steps = static_cast<int>(std::clamp(std::ceil(way / kStep), 1.0, double{kMostSteps}));
    const double step = nearest / steps;
    double beforeHere = nearest + step, beforeSeen = nearest, front = nearest;
    bool wasFront = false;
    for (int n = 0; n <= steps; ++n) {
        const double here = n == steps ? 0 : nearest - step * n, there = inverseAt(seen, ray.at(here));
        if (there >= here) {
            const double jump = kJump * step / kStep;
            if (there <= here + step) return {there, false};
            if (wasFront && there - beforeSeen <= jump) {
                const double gap = beforeHere - beforeSeen, over = there - here;
                return {beforeHere - step * gap / std::max(gap + over, 1e-300), false};
            }
            wasFront = false;
        } else {
            front = here;
            wasFront = true;
        }
        beforeHere = here;
        beforeSeen = there;
    }
    return {front, true};
}

}  // namespace

void warpLatePlainly(const Plane<PackedColor>& color, const Plane<float>& depth, const EyeView& from,
                     const EyeView& to, Plane<PackedColor>& image, Plane<std::uint8_t>& uncovered) {
    Seen seen{color, Plane<double>(depth.width(), depth.height()), 0};
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x) {
            seen.inverse.at(x, y) = knownInverse(depth, x, y);
            seen.nearest = std::max(seen.nearest, seen.inverse.at(x, y));
        }
    image.resize(to.width, to.height);
    uncovered.resize(to.width, to.height);
    const glm::dvec3 away = to.eye - from.eye;
    const double ahead = glm::dot(away, from.forward);
    const double near = to.nearDepth + ahead;
    const double nearest = near > 0 ? std::min(seen.nearest, 1 / near) : seen.nearest;
    for (int y = 0; y < to.height; ++y)
        for (int x = 0; x < to.width; ++x) {
            const glm::dvec3 direction = to.rayDirection(x + 0.5, y + 0.5);
            const glm::dvec3 infinite = from.project(from.eye + direction);
            if (!(infinite.z > 1e-3)) {
                image.at(x, y) = color.at(0, 0);
                uncovered.at(x, y) = 255;
                continue;
            }
            const glm::dvec2 a(infinite.x, infinite.y);
            const glm::dvec2 shift(
                (glm::dot(away, from.right) - from.xMin * ahead) / from.pixelWidth() - ahead * a.x,
                (from.yMax * ahead - glm::dot(away, from.up)) / from.pixelHeight() - ahead * a.y);
            const Ray ray{a, shift};
            const Met met = follow(seen, ray, nearest);
            const glm::dvec2 place = ray.at(met.inverse);
            const double inverse = met.uncovered ? inverseAt(seen, place) : met.inverse;
            // On a slope neighbours are further apart in depth, but not on the screen.
            const double pixel = met.uncovered ? 0 : 1 / std::max(glm::length(shift), 1e-30);
            image.at(x, y) = colorOf(seen, place, inverse, std::max(kSurface * inverse + 1e-9, pixel));
            const bool beside =
                place.x < 0 || place.y < 0 || place.x > color.width() || place.y > color.height();
            uncovered.at(x, y) = met.uncovered || beside ? 255 : 0;
        }
}

}  // namespace stereonav
