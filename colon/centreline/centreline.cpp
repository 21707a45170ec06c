// Finds the centreline: a rough way through each piece of lumen, refined, and the pieces put in order.
#include "colon/centreline/centreline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "colon/centreline/centreline_path.h"
#include "colon/centreline/centreline_refine.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr const char* kFinding = "finding the centreline";

void check(const LumenField& lumen, const DistanceVolume& distance, const CentrelineSetting& setting) {
    if (!(setting.spacing > 0) || !std::isfinite(setting.spacing))
        throw Error("", "centreline spacing",
                    fmt::format("expected metres, more than 0, got {:g}", setting.spacing), "use 0.001");
    if (lumen.segments.empty() || lumen.lumen.empty())
        throw Error("", "", "the lumen is empty, so it has no centreline", "segment the study again");
    if (distance.frame.size != lumen.lumen.frame.size || !(distance.unit > 0))
        throw Error("", "", "the distances are not those of the lumen", "compute them from its mask");
}

// Returns whether the line runs from the rectum upwards: its start is lower, or, where the ends are about
// level (within a tenth of the line's height or an end's radius), further back.
bool startsAtRectum(const LumenProbe& probe, const std::vector<glm::dvec3>& points) {
    const glm::dvec3 a = points.front(), b = points.back();
    double low = a.z, high = a.z;
    for (const glm::dvec3& p : points) {
        low = std::min(low, p.z);
        high = std::max(high, p.z);
    }
    const double level = std::max({0.1 * (high - low), probe.radius(a), probe.radius(b)});
    if (std::abs(a.z - b.z) > level) return a.z < b.z;
    return a.y != b.y ? a.y > b.y : a.z <= b.z;
}

std::vector<glm::dvec3> linePoints(const LumenField& lumen, int segment, const DistanceVolume& distance,
                                   const CentrelineSetting& setting, const std::function<void()>& poll) {
    std::vector<glm::dvec3> rough;
    for (const glm::ivec3& v : roughCentreline(lumen, segment, distance, setting.mostUneven, poll))
        rough.push_back(lumen.lumen.frame.worldFromVoxel(glm::dvec3(v)));
    // A point each millimetre of a lumen of kilometres would be more than anybody waits for.
    constexpr double kMostPoints = 50'000;
    const LumenProbe probe(lumen, distance, segment);
    const std::vector<glm::dvec3> refined = refineCentreline(probe, rough, poll);
    const double spacing = std::max(setting.spacing, polylineLength(refined) / kMostPoints);
    std::vector<glm::dvec3> points = resampleEvenly(probe, refined, spacing);
    if (!startsAtRectum(probe, points)) std::reverse(points.begin(), points.end());
    return points;
}

}  // namespace

double Centreline::length() const {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        sum += glm::length(points[i].position - points[i - 1].position);
    return sum;
}

Centreline findCentreline(const LumenField& lumen, const DistanceVolume& distance,
                          const CentrelineSetting& setting, Progress& progress) {
    check(lumen, distance, setting);
    Centreline line;
    const int count = static_cast<int>(lumen.segments.size());
    for (int segment = 1; segment <= count; ++segment) {
        const auto poll = [&] { progress.report(static_cast<double>(segment - 1) / count, kFinding); };
        poll();
        std::vector<glm::dvec3> piece = linePoints(lumen, segment, distance, setting, poll);
        if (!line.points.empty()) {  // goes on at the end that is nearer
            const glm::dvec3 last = line.points.back().position;
            if (glm::length(piece.back() - last) < glm::length(piece.front() - last))
                std::reverse(piece.begin(), piece.end());
        }
        const LumenProbe probe(lumen, distance, segment);
        for (const glm::dvec3& p : piece) line.points.push_back({p, probe.radius(p), segment});
    }
    if (setting.reversed) std::reverse(line.points.begin(), line.points.end());
    progress.report(1, kFinding);
    return line;
}

}  // namespace stereonav
