#include "colon/instruments/registration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/base/error.h"

namespace stereonav {
namespace {

// Features of one place of a line, by which two lines are compared.
struct Feature {
    double along;                 // metres
    double share;                 // share of the whole length
    double radius;                // logarithm, less the line's mean
    glm::dvec3 place, direction;  // smoothed; unit
    double turn;                  // curvature times kTurn
};

constexpr double kTurn = 0.02;  // metres

std::vector<double> walkedAlong(const Centreline& line) {
    std::vector<double> along{0};
    for (std::size_t n = 1; n < line.points.size(); ++n)
        along.push_back(along.back() + glm::distance(line.points[n].position, line.points[n - 1].position));
    return along;
}

// A Gaussian over samples `step` apart; at the ends what is there weighs more.
template <typename T>
std::vector<T> smoothed(const std::vector<T>& values, double sigma) {
    const int reach = static_cast<int>(std::ceil(3 * sigma)), count = static_cast<int>(values.size());
    std::vector<T> result(values.size());
    for (int n = 0; n < count; ++n) {
        // The window reaches as far to one side as to the other, so that ends are not drawn inwards.
        const int here = std::min({reach, n, count - 1 - n});
        T sum{};
        double weights = 0;
        for (int k = -here; k <= here; ++k) {
            const double w = std::exp(-0.5 * k * k / (sigma * sigma));
            sum += w * values[n + k];
            weights += w;
        }
        result[n] = sum / weights;
    }
    return result;
}

std::vector<Feature> featuresOf(const Centreline& line, const RegistrationSetting& setting) {
    const std::vector<double> along = walkedAlong(line);
    const double length = along.back();
    if (line.points.size() < 2 || !(length > 0))
        throw Error("registration", "", "expected a centreline of two places or more",
                    "choose another study");
    // Places of one line times those of the other are held: of very long lines they are further apart.
    constexpr double kMostPlaces = 4000;
    const int count = static_cast<int>(std::clamp(std::round(length / setting.step), 4.0, kMostPlaces)) + 1;
    std::vector<glm::dvec3> places(count);
    std::vector<double> radii(count);
    std::size_t at = 0;
    for (int n = 0; n < count; ++n) {
        const double wanted = length * n / (count - 1);
        while (at + 2 < along.size() && along[at + 1] < wanted) ++at;
        const double step = along[at + 1] - along[at];
        const double t = step > 0 ? std::clamp((wanted - along[at]) / step, 0.0, 1.0) : 0;
        places[n] = glm::mix(line.points[at].position, line.points[at + 1].position, t);
        radii[n] = std::log(std::max(glm::mix(line.points[at].radius, line.points[at + 1].radius, t), 1e-4));
    }
    const double apart = length / (count - 1), sigma = setting.smooth / apart;
    places = smoothed(places, sigma);
    radii = smoothed(radii, sigma);
    double mean = 0;
    for (const double radius : radii) mean += radius / count;
    std::vector<Feature> features(count);
    for (int n = 0; n < count; ++n) {
        const glm::dvec3 way = places[std::min(n + 1, count - 1)] - places[std::max(n - 1, 0)];
        const double step = glm::length(way);
        features[n] = {length * n / (count - 1),
                       static_cast<double>(n) / (count - 1),
                       radii[n] - mean,
                       places[n],
                       step > 0 ? way / step : glm::dvec3(0, 0, 1),
                       0};
    }
    for (int n = 1; n + 1 < count; ++n)
        features[n].turn =
            kTurn * glm::length(features[n + 1].direction - features[n - 1].direction) / (2 * apart);
    return features;
}

double differenceOf(const Feature& a, const Feature& b, const RegistrationSetting& s) {
    const glm::dvec3 turned = a.direction - b.direction;
    const double radius = a.radius - b.radius, turn = a.turn - b.turn, share = a.share - b.share;
    return s.radius * radius * radius + s.direction * glm::dot(turned, turned) + s.turn * turn * turn +
           s.length * share * share;
}

}  // namespace

LineRegistration::LineRegistration(const Centreline& first, const Centreline& second,
                                   const RegistrationSetting& setting) {
    const std::vector<Feature> a = featuresOf(first, setting), b = featuresOf(second, setting);
    const int rows = static_cast<int>(a.size()), columns = static_cast<int>(b.size());
    // Ways to a cell: one of each; one and two; two and one. Lines of which one is longer than twice the
    // other need more: then as many of the longer as it takes.
    const int shorter = std::max(std::min(rows, columns) - 1, 1), longer = std::max(rows, columns) - 1;
    const int most = std::max(2, (longer + shorter - 1) / shorter);
    constexpr double kNone = std::numeric_limits<double>::infinity();
    std::vector<double> best(static_cast<std::size_t>(rows) * columns, kNone);
    std::vector<std::uint16_t> from(best.size(), 0);
    const auto index = [columns](int i, int j) { return static_cast<std::size_t>(i) * columns + j; };
    const auto cost = [&](int i, int j) { return differenceOf(a[i], b[j], setting); };
    best[0] = cost(0, 0);
    for (int i = 1; i < rows; ++i)
        for (int j = 1; j < columns; ++j) {
            const double here = cost(i, j);
            const auto offer = [&](int di, int dj, std::uint16_t way) {
                if (i < di || j < dj) return;
                // Weighted by the steps that it takes of both, so that long ways are not cheaper.
                const double sum = best[index(i - di, j - dj)] + 0.5 * (di + dj) * here;
                if (sum < best[index(i, j)]) best[index(i, j)] = sum, from[index(i, j)] = way;
            };
            offer(1, 1, 1);
            for (int k = 2; k <= most; ++k) {
                offer(k, 1, static_cast<std::uint16_t>(2 * k));
                offer(1, k, static_cast<std::uint16_t>(2 * k + 1));
            }
        }
    mCost = best[index(rows - 1, columns - 1)] / std::max(rows, columns);
    if (!(mCost < kNone))
        throw Error("registration", "", "the two centrelines can not be matched", "choose another study");
    for (int i = rows - 1, j = columns - 1;;) {
        mPairs.push_back({a[i].along, b[j].along});
        const std::uint16_t way = from[index(i, j)];
        if (way == 0) break;
        const int k = way == 1 ? 1 : way / 2;
        i -= way == 1 || way % 2 == 1 ? 1 : k;
        j -= way == 1 || way % 2 == 0 ? 1 : k;
    }
    std::reverse(mPairs.begin(), mPairs.end());
}

double LineRegistration::mapped(const std::vector<Pair>& pairs, double along, bool back) {
    const auto key = [back](const Pair& p) { return back ? p.second : p.first; };
    const auto value = [back](const Pair& p) { return back ? p.first : p.second; };
    const auto after =
        std::partition_point(pairs.begin(), pairs.end(), [&](const Pair& p) { return key(p) < along; });
    if (after == pairs.begin()) return value(pairs.front());
    if (after == pairs.end()) return value(pairs.back());
    const Pair &low = *(after - 1), &high = *after;
    const double t = (along - key(low)) / (key(high) - key(low));
    return value(low) + t * (value(high) - value(low));
}

glm::dvec3 placeAlong(const Centreline& line, double along) {
    double walked = 0;
    for (std::size_t n = 1; n < line.points.size(); ++n) {
        const glm::dvec3 &a = line.points[n - 1].position, &b = line.points[n].position;
        const double step = glm::distance(a, b);
        if (walked + step >= along)
            return step > 0 ? glm::mix(a, b, std::clamp((along - walked) / step, 0.0, 1.0)) : a;
        walked += step;
    }
    return line.points.back().position;
}

}  // namespace stereonav
