// The automatic flight: positions are the centreline's own, one sample every kSpacing of it, so that the
// straight lines between samples are the centreline too. The view looks ahead by a distance that goes with
// the lumen's width; its direction is smoothed along the line, and the head turns along the shortest arcs
// (parallel transport), so that nothing rolls of itself.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "colon/flight/colon_flight.h"
#include "colon/flight/colon_flight_line.h"
#include "colon/flight/colon_flight_view.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kSpacing = 0.001;      // metres between samples
constexpr double kMostSamples = 1e6;    // samples of a run; in longer ones they lie wider apart
constexpr double kPathLookRadii = 1.5;  // the view aims so many free distances ahead
constexpr double kPathNearestLook = 0.008, kPathFarthestLook = 0.03;  // metres
constexpr double kPathSmoothing = 0.02;                               // metres along the line
// Cuts lie between the multiples of this, where the frames at all usual rates are.
constexpr double kFrameGrid = 1.0 / 600;  // seconds

struct Stop {
    glm::dvec3 position, direction;  // direction: unit, of the view
};

// An exponential filter there and back: no shift along the line.
void smooth(std::vector<Stop>& stops, double spacing) {
    const double keep = std::exp(-spacing / kPathSmoothing);
    const auto pass = [keep](auto first, auto last) {
        glm::dvec3 mean = first->direction;
        for (auto stop = first; stop != last; ++stop) {
            mean = glm::mix(stop->direction, mean, keep);
            const double length = glm::length(mean);
            if (length > 1e-6) stop->direction = mean / length;
        }
    };
    pass(stops.begin(), stops.end());
    pass(stops.rbegin(), stops.rend());
}

std::vector<Stop> stopsOf(const FlightLine& line, const FlightRun& run, bool backwards) {
    const double length = run.last - run.first;
    const int pieces =
        std::max(1, static_cast<int>(std::ceil(std::min(length / kSpacing, kMostSamples) - 1e-9)));
    std::vector<Stop> stops;
    for (int k = 0; k <= pieces; ++k) {
        const double s = run.first + length * (backwards ? pieces - k : k) / pieces;
        const double look = std::clamp(kPathLookRadii * line.widthAt(s), kPathNearestLook, kPathFarthestLook);
        const glm::dvec3 position = line.at(s);
        const glm::dvec3 way = line.ahead(run, backwards ? s - look : s + look) - position;
        const double distance = glm::length(way);
        const glm::dvec3 tangent = (backwards ? -1.0 : 1.0) * line.direction(run, s);
        stops.push_back({position, distance > 1e-9 ? way / distance : tangent});
    }
    smooth(stops, length / pieces);
    return stops;
}

// Returns a view in that direction, with the head as upright as it can be.
FlightView startView(const glm::dvec3& direction) {
    const double pitch = std::asin(std::clamp(direction.z, -1.0, 1.0));
    const double heading = std::atan2(direction.x, direction.y);
    return {poseFromAngles(glm::dvec3(0.0), heading, pitch, 0).orientation, 0, 0, 0};
}

// The first moment from `earliest` on at which a cut can begin and lie between frames.
double cutAfter(double earliest) {
    const double lead = (kFrameGrid - kFlightCut) / 2;
    return std::ceil((earliest - lead) / kFrameGrid) * kFrameGrid + lead;
}

}  // namespace

RecordedPath centrelineFlight(const FreeDistance& freeDistance, const Centreline& centreline,
                              const ColonFlightSetting& setting, bool backwards) {
    checkColonFlightSetting(setting);
    const FlightLine line(centreline, freeDistance, setting.clearance, setting.largestSeparation / 2);
    if (line.runs().empty())
        throw Error("", "centreline", "expected a stretch with room for the eyes, found none",
                    "a colon is flown through where there is more room than its eyes take");
    std::vector<FlightRun> runs = line.runs();
    if (backwards) std::reverse(runs.begin(), runs.end());
    std::vector<PathSample> samples;
    FlightView view;
    double start = 0;
    for (const FlightRun& run : runs) {
        const std::vector<Stop> stops = stopsOf(line, run, backwards);
        view = samples.empty() ? startView(stops.front().direction) : view.facing(stops.front().direction, 1);
        const double end = start + (run.last - run.first) / setting.speed;
        const bool isLast = &run == &runs.back();
        const double duration = (isLast ? end : cutAfter(end)) - start;
        const double pieces = static_cast<double>(stops.size() - 1);
        for (std::size_t k = 0; k < stops.size(); ++k) {
            view = view.facing(stops[k].direction, 1);
            const double time = start + duration * static_cast<double>(k) / pieces;
            samples.push_back({time, {stops[k].position, view.orientation()}});
        }
        start += duration + kFlightCut;
    }
    return RecordedPath(std::move(samples), "flight along the centreline");
}

}  // namespace stereonav
