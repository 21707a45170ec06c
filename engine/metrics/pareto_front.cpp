// Which ways of doing something no other beats in both time and error.
#include <algorithm>

#include "engine/metrics/error_plot.h"

namespace stereonav {

static bool beats(const PlotPoint& a, const PlotPoint& b) {
    return a.time_ms <= b.time_ms && a.error <= b.error && (a.time_ms < b.time_ms || a.error < b.error);
}

std::vector<std::size_t> paretoFront(const std::vector<PlotPoint>& points) {
    std::vector<std::size_t> front;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto beatsThis = [&](const PlotPoint& other) { return beats(other, points[k]); };
        if (std::none_of(points.begin(), points.end(), beatsThis)) front.push_back(k);
    }
    std::sort(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
        return points[a].time_ms < points[b].time_ms || (points[a].time_ms == points[b].time_ms && a < b);
    });
    return front;
}

}  // namespace stereonav
