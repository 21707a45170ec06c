// Over ground the way is raised by a morphological closing of the needed rise, like a terrain's own flight:
// the largest need within a window, smoothed over a window of half its width. So it is nowhere below the
// need.
#include "engine/nav/flight_way.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace stereonav {
namespace {

constexpr int kPieces = 1024;  // pieces of a way over ground: finer than frames of the shortest flight
constexpr int kWindow = 96;    // pieces to each side that a rise is spread over
constexpr int kBendPieces = 48;
constexpr int kBendSides = 12;
constexpr double kBends[] = {0.15, 0.3, 0.6, 1.2, 2.4};  // how far aside, in lengths of the straight way

// Returns how many pieces a window reaches to each side of place k: `most`, fewer near the ends of the way.
int windowAt(int k, int most) {
    return std::min({most, k, kPieces - k});
}

// Returns the largest need within each place's window.
std::vector<double> widened(const std::vector<double>& needs) {
    std::vector<double> most(needs.size());
    for (int k = 0; k <= kPieces; ++k) {
        const int window = windowAt(k, kWindow);
        most[k] = *std::max_element(needs.begin() + k - window, needs.begin() + k + window + 1);
    }
    return most;
}

// Returns weighted means over half of each place's window. Weights fall to 0 at its ends, so that the way has
// no kinks.
std::vector<double> smoothed(const std::vector<double>& values) {
    std::vector<double> means(values.size());
    for (int k = 0; k <= kPieces; ++k) {
        const int window = windowAt(k, kWindow) / 2;
        double sum = 0, weights = 0;
        for (int j = -window; j <= window; ++j) {
            const double weight = 1 + std::cos(std::numbers::pi * j / (window + 1.0));
            sum += weight * values[k + j];
            weights += weight;
        }
        means[k] = sum / weights;
    }
    return means;
}

std::vector<glm::dvec3> overGround(const Flight& flight, const glm::dvec3& from, const glm::dvec3& to) {
    std::vector<glm::dvec3> places(kPieces + 1);
    std::vector<double> needs(kPieces + 1);
    bool raised = false;
    for (int k = 0; k <= kPieces; ++k) {
        places[k] = glm::mix(from, to, k / double(kPieces));
        needs[k] = std::max(0.0, flight.lowestAt(places[k]) - places[k].z);
        raised = raised || needs[k] > 0;
    }
    if (!raised) return {from, to};
    const std::vector<double> raises = smoothed(widened(needs));
    for (int k = 0; k <= kPieces; ++k) places[k].z += raises[k];
    return places;
}

std::vector<glm::dvec3> bend(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& aside) {
    const glm::dvec3 middle =
        0.5 * (from + to) + 2.0 * aside;  // middle of the control polygon: half of it is reached
    std::vector<glm::dvec3> places(kBendPieces + 1);
    for (int k = 0; k <= kBendPieces; ++k) {
        const double t = k / double(kBendPieces);
        places[k] = (1 - t) * (1 - t) * from + 2 * t * (1 - t) * middle + t * t * to;
    }
    return places;
}

bool isClear(const Flight& flight, const std::vector<glm::dvec3>& places) {
    for (std::size_t k = 1; k < places.size(); ++k)
        if (!flight.wayIsClear(places[k - 1], places[k])) return false;
    return true;
}

std::vector<glm::dvec3> aroundWalls(const Flight& flight, const glm::dvec3& from, const glm::dvec3& to) {
    std::vector<glm::dvec3> straight{from, to};
    const double length = glm::distance(from, to);
    if (!(length > 0) || flight.wayIsClear(from, to)) return straight;
    const glm::dvec3 way = (to - from) / length;
    const glm::dvec3 other = std::abs(way.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 side = glm::normalize(glm::cross(way, other)), up = glm::cross(side, way);
    for (const double far : kBends)
        for (int k = 0; k < kBendSides; ++k) {
            const double angle = 2 * std::numbers::pi * k / kBendSides;
            const glm::dvec3 aside = (std::cos(angle) * side + std::sin(angle) * up) * (far * length);
            std::vector<glm::dvec3> places = bend(from, to, aside);
            if (isClear(flight, places)) return places;
        }
    return straight;
}

}  // namespace

FlightWay::FlightWay(std::vector<glm::dvec3> places) : mPlaces(std::move(places)), mAlong(mPlaces.size()) {
    for (std::size_t k = 1; k < mPlaces.size(); ++k)
        mAlong[k] = mAlong[k - 1] + glm::distance(mPlaces[k - 1], mPlaces[k]);
}

glm::dvec3 FlightWay::at(double share) const {
    if (!(share > 0)) return mPlaces.front();
    if (share >= 1) return mPlaces.back();
    const double wanted = share * length();
    const auto after = std::upper_bound(mAlong.begin(), mAlong.end(), wanted);
    if (after == mAlong.end()) return mPlaces.back();
    const auto k = static_cast<std::size_t>(after - mAlong.begin());
    return glm::mix(mPlaces[k - 1], mPlaces[k], (wanted - mAlong[k - 1]) / (mAlong[k] - mAlong[k - 1]));
}

FlightWay wayBetween(const Flight& flight, const glm::dvec3& from, const glm::dvec3& to) {
    std::vector<glm::dvec3> places = overGround(flight, from, to);
    if (places.size() == 2) places = aroundWalls(flight, from, to);
    return FlightWay(std::move(places));
}

}  // namespace stereonav
