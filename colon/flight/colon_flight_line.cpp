// Free distances are taken at the points; in narrow parts at more points between them, so that what is
// known to hold between two points (it falls by at most a metre a metre) loses little.
#include "colon/flight/colon_flight_line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace stereonav {
namespace {

// Metres of room beside the line that are told apart; on a real colon, looking 10 mm far in all took 0.07 s
// and 30 mm far 1.4 s.
constexpr double kWide = 0.006;
constexpr double kFinest = 0.00025;   // metres between places in narrow parts, or
constexpr double kFineShare = 0.125;  // this share of the clearance, if less
constexpr int kMostBetween = 64;      // places between two points
constexpr double kTangent = 0.003;    // metres to each side that make a direction

bool isFinite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

double freeAtPoint(const FreeDistance& free, const glm::dvec3& p, double farthest) {
    const double distance = free(p, farthest);
    return distance > 0 ? std::min(distance, farthest) : 0.0;
}

}  // namespace

FlightLine::FlightLine(const Centreline& line, const FreeDistance& freeDistance, double clearance,
                       double half)
    : mFarthest(clearance / kShare + half + kWide) {
    for (std::size_t k = 0; k < line.points.size(); ++k) {
        const CentrelinePoint& point = line.points[k];
        if (!isFinite(point.position)) {
            if (!mPlaces.empty()) mPlaces.back().endsSegment = true;
            continue;
        }
        const double free = freeAtPoint(freeDistance, point.position, mFarthest);
        const double width = std::isfinite(point.radius) ? std::max(point.radius, free) : free;
        if (!mPlaces.empty()) {
            // Points left out or of another segment: the line is cut.
            const bool cut = mPlaces.back().endsSegment || point.segment != line.points[k - 1].segment;
            mPlaces.back().endsSegment = cut;
            if (!cut) addPieces(point.position, free, freeDistance, clearance, half);
        }
        const double step = mPlaces.empty() ? 0 : glm::distance(mPlaces.back().position, point.position);
        if (!mPlaces.empty() && !mPlaces.back().endsSegment && step <= 0) continue;
        const double along = mPlaces.empty() ? 0 : mPlaces.back().along + std::max(step, 1e-9);
        mPlaces.push_back({point.position, along, 0, free, width, false});
    }
    if (!mPlaces.empty()) mPlaces.back().endsSegment = true;
    for (std::size_t k = 0; k < mPlaces.size(); ++k) measure(k, clearance, half);
    findRuns();
}

void FlightLine::addPieces(const glm::dvec3& to, double freeThere, const FreeDistance& free, double clearance,
                           double half) {
    const Place first = mPlaces.back();
    const double length = glm::distance(first.position, to);
    const double certain = (first.free + freeThere - length) / 2;
    if (certain - half >= clearance / kShare) return;
    const double finest = std::min(kFinest, kFineShare * clearance);
    const int pieces = static_cast<int>(std::min<double>(std::ceil(length / finest), kMostBetween));
    for (int k = 1; k < pieces; ++k) {
        const glm::dvec3 p = glm::mix(first.position, to, static_cast<double>(k) / pieces);
        mPlaces.push_back(
            {p, first.along + length * k / pieces, 0, freeAtPoint(free, p, mFarthest), first.width, false});
    }
}

// Measures free distance, the clearance allowed there and the room left, such that they hold half way to the
// neighbours too.
void FlightLine::measure(std::size_t k, double clearance, double half) {
    Place& place = mPlaces[k];
    const double before = k > 0 && !mPlaces[k - 1].endsSegment ? place.along - mPlaces[k - 1].along : 0.0;
    const double after = !place.endsSegment ? mPlaces[k + 1].along - place.along : 0.0;
    const double reach = std::max(before, after) / 2;
    const double beside = place.free - reach - half;
    const double allowed = std::min(clearance, kShare * beside);
    // Around a narrow place the allowed clearance grows again, which takes from the room beside the line.
    place.room = (beside - allowed) / (allowed < clearance ? LumenRoom::kSlope : 1.0);
    if (beside < kLeast * clearance)
        place.room = 0;
    else if (allowed < clearance)
        mNarrow.push_back({place.position, reach, allowed});
}

void FlightLine::findRuns() {
    for (std::size_t first = 0; first < mPlaces.size(); ++first) {
        if (!(mPlaces[first].room > 0)) continue;
        std::size_t last = first;
        while (!mPlaces[last].endsSegment && mPlaces[last + 1].room > 0) ++last;
        if (last > first) mRuns.push_back({mPlaces[first].along, mPlaces[last].along});
        first = last;
    }
}

std::size_t FlightLine::pieceAt(double s) const {
    const auto after = std::upper_bound(mPlaces.begin(), mPlaces.end(), s,
                                        [](double value, const Place& p) { return value < p.along; });
    const auto index = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - mPlaces.begin() - 1, 0));
    return std::min(index, mPlaces.size() - 2);
}

std::size_t FlightLine::placeAt(double s) const {
    const std::size_t k = pieceAt(s);
    return s - mPlaces[k].along <= mPlaces[k + 1].along - s ? k : k + 1;
}

glm::dvec3 FlightLine::at(double s) const {
    const std::size_t k = pieceAt(s);
    const Place &a = mPlaces[k], &b = mPlaces[k + 1];
    return glm::mix(a.position, b.position, std::clamp((s - a.along) / (b.along - a.along), 0.0, 1.0));
}

glm::dvec3 FlightLine::direction(const FlightRun& run, double s) const {
    const double from = std::max(run.first, std::min(s, run.last) - kTangent);
    const double to = std::min(run.last, std::max(s, run.first) + kTangent);
    const glm::dvec3 way = at(to) - at(from);
    const double length = glm::length(way);
    return length > 0 ? way / length : glm::dvec3(0, 0, 1);
}

glm::dvec3 FlightLine::ahead(const FlightRun& run, double s) const {
    const double inside = std::clamp(s, run.first, run.last);
    const glm::dvec3 point = at(inside);
    return inside == s ? point : point + (s - inside) * direction(run, inside);
}

double FlightLine::nearest(const glm::dvec3& p, double from, double to) const {
    double best = from, leastSquare = -1;
    for (std::size_t k = pieceAt(from); k + 1 < mPlaces.size() && mPlaces[k].along <= to; ++k) {
        const Place &a = mPlaces[k], &b = mPlaces[k + 1];
        const glm::dvec3 way = b.position - a.position;
        const double square = glm::dot(way, way);
        const double t = square > 0 ? glm::dot(p - a.position, way) / square : 0.0;
        const double s = std::clamp(a.along + std::clamp(t, 0.0, 1.0) * (b.along - a.along), from, to);
        const glm::dvec3 off = p - at(s);
        if (leastSquare >= 0 && glm::dot(off, off) >= leastSquare) continue;
        leastSquare = glm::dot(off, off);
        best = s;
    }
    return best;
}

}  // namespace stereonav
