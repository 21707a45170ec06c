// The clearance that a flight really keeps from the wall. The distance to it changes by at most a metre a
// metre of way, so two looks bound it on all of the way between them; where the bound does not tell enough
// there is another look half way.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "colon/flight/colon_flight.h"

namespace stereonav {
namespace {

constexpr double kFirstLook = 0.002,
                 kFartherLook = 4;    // metres; and how much further where no wall is so near
constexpr double kTightness = 1e-5;   // metres, or
constexpr double kTightShare = 5e-6;  // share of the flight's length, which bounds how many looks are taken
constexpr int kMostHalvings = 20;     // halvings of the way between two samples

double freeAt(const FreeDistance& free, const glm::dvec3& point, double upTo) {
    const double distance = free(point, upTo);
    return distance > 0 ? std::min(distance, upTo) : 0.0;  // NaN is no room
}

// One of the points that fly: the head, or an eye aside of it.
struct Flier {
    const RecordedPath& path;
    const FreeDistance& free;
    double aside;  // metres to the head's right
    double tightness, upTo;

    struct Look {
        double time, distance;
        Pose pose;
    };
    Look lookAt(double time) const {
        const Pose pose = path.at(time);
        const glm::dvec3 right = pose.orientation * glm::dvec3(1, 0, 0);
        return {time, freeAt(free, pose.position + aside * right, upTo), pose};
    }
    // Returns a distance, at least as far as the point moves from one to the other.
    double way(const Look& a, const Look& b) const {
        const glm::dquat turn = glm::conjugate(a.pose.orientation) * b.pose.orientation;
        const double sine = glm::length(glm::dvec3(turn.x, turn.y, turn.z));
        return glm::distance(a.pose.position, b.pose.position) +
               std::abs(aside) * 2 * std::asin(std::min(sine, 1.0));
    }

    // Returns a bound: never above what is kept between the two, and below it by no more than the tightness
    // or the whole flight's least, which is brought down by each look.
    double leastBetween(const Look& a, const Look& b, double& leastSeen, int halvings) const {
        leastSeen = std::min({leastSeen, a.distance, b.distance});
        const double bound = std::max(0.0, (a.distance + b.distance - way(a, b)) / 2);
        if (bound >= leastSeen - tightness || halvings == kMostHalvings) return bound;
        const Look middle = lookAt((a.time + b.time) / 2);
        return std::min(leastBetween(a, middle, leastSeen, halvings + 1),
                        leastBetween(middle, b, leastSeen, halvings + 1));
    }

    double leastOfAll() const {
        const std::vector<PathSample>& samples = path.samples();
        std::vector<Look> looks;
        double seen = upTo;
        for (const PathSample& sample : samples) {
            looks.push_back(lookAt(sample.time));
            seen = std::min(seen, looks.back().distance);
        }
        double least = seen;
        for (std::size_t n = 1; n < looks.size(); ++n)
            if (looks[n].time - looks[n - 1].time > 1.5 * kFlightCut)  // no frame shows what lies in a cut
                least = std::min(least, leastBetween(looks[n - 1], looks[n], seen, 0));
        return least;
    }
};

double lengthOf(const RecordedPath& path) {
    double length = 0;
    const std::vector<PathSample>& samples = path.samples();
    for (std::size_t n = 1; n < samples.size(); ++n)
        length += glm::distance(samples[n - 1].pose.position, samples[n].pose.position);
    return length;
}

double leastOf(const RecordedPath& path, const FreeDistance& free, double aside) {
    const double tightness = std::max(kTightness, kTightShare * lengthOf(path));
    double upTo = std::max(kFirstLook, 8 * tightness);
    for (;; upTo = std::min(kFartherLook * upTo, ColonFlight::kFarthestClearance)) {
        const double least = Flier{path, free, aside, tightness, upTo}.leastOfAll();
        if (least < upTo - 2 * tightness || upTo >= ColonFlight::kFarthestClearance)
            return std::min(least, ColonFlight::kFarthestClearance);
    }
}

}  // namespace

double clearanceAt(const FreeDistance& freeDistance, const Pose& head, double separation) {
    const glm::dvec3 right = head.orientation * glm::dvec3(1, 0, 0);
    double nearest = ColonFlight::kFarthestClearance;
    for (const double aside : {-separation / 2, 0.0, separation / 2})
        nearest = std::min(nearest, freeAt(freeDistance, head.position + aside * right, nearest));
    return nearest;
}

FlightClearance clearanceOf(const RecordedPath& path, const FreeDistance& freeDistance, double separation) {
    FlightClearance clearance;
    clearance.head = leastOf(path, freeDistance, 0);
    clearance.eyes = clearance.head;
    if (separation > 0)
        clearance.eyes = std::min(leastOf(path, freeDistance, -separation / 2),
                                  leastOf(path, freeDistance, separation / 2));
    return clearance;
}

}  // namespace stereonav
