#include "engine/metrics/pareto_verdict.h"

#include <fmt/format.h>

#include <algorithm>

namespace stereonav {
namespace {

bool beats(glm::dvec2 a, glm::dvec2 b) {
    return a.x <= b.x && a.y <= b.y && (a.x < b.x || a.y < b.y);
}

glm::dvec2 placeOf(const Way& way) {
    return {way.time.low, way.error};
}

bool beats(const Way& a, const Way& b) {
    return a.time.count > 0 && beats(placeOf(a), placeOf(b));
}

// Returns whether a beats b by more than repeats of one measurement usually differ.
bool clearlyBeats(const Way& a, const Way& b) {
    return beats(a, b) && (a.time.median < b.time.low || a.error < b.error * (1 - kSameError));
}

double shareSaved(double from, double to) {
    return from > 0 ? 1 - to / from : 0.0;
}

std::string verdictText(const Way& way, const ParetoVerdict& verdict) {
    if (verdict.onFront) return fmt::format("The default, {}, is on the front.", way.name);
    if (way.time.count == 0) return fmt::format("The default, {}, was not measured.", way.name);
    const std::string by =
        verdict.faster == verdict.better
            ? fmt::format("{} takes {:.1f} % less time with {:.1f} % less error", verdict.faster,
                          100 * verdict.timeSaved, 100 * verdict.errorSaved)
            : fmt::format(
                  "{} takes {:.1f} % less time without more error, {} has {:.1f} % less error in no more "
                  "time",
                  verdict.faster, 100 * verdict.timeSaved, verdict.better, 100 * verdict.errorSaved);
    return verdict.withinNoise
               ? fmt::format("The default, {}, is on the front within the spread of repeats: {}.", way.name,
                             by)
               : fmt::format("The default, {}, is not on the front: {}.", way.name, by);
}

}  // namespace

std::vector<std::size_t> paretoFront(const std::vector<glm::dvec2>& points) {
    std::vector<std::size_t> front;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (std::ranges::none_of(points, [&](glm::dvec2 other) { return beats(other, points[k]); }))
            front.push_back(k);
    std::ranges::stable_sort(front, {}, [&](std::size_t k) { return points[k].x; });
    return front;
}

std::vector<std::size_t> frontOf(const std::vector<Way>& ways) {
    std::vector<glm::dvec2> points;
    std::vector<std::size_t> measured;
    for (std::size_t n = 0; n < ways.size(); ++n)
        if (ways[n].time.count > 0) {
            points.push_back(placeOf(ways[n]));
            measured.push_back(n);
        }
    std::vector<std::size_t> front = paretoFront(points);
    for (std::size_t& n : front) n = measured[n];
    return front;
}

ParetoVerdict verdictOf(const std::vector<Way>& ways, std::size_t which) {
    const Way& way = ways[which];
    ParetoVerdict verdict;
    if (way.time.count == 0) return verdict;
    bool beaten = false, clearly = false;
    double leastTime = way.time.low, leastError = way.error;
    for (const Way& other : ways) {
        if (!beats(other, way)) continue;
        clearly |= clearlyBeats(other, way);
        if (!beaten || other.time.low < leastTime) verdict.faster = other.name, leastTime = other.time.low;
        if (!beaten || other.error < leastError) verdict.better = other.name, leastError = other.error;
        beaten = true;
    }
    verdict.onFront = !beaten;
    verdict.withinNoise = beaten && !clearly;
    verdict.timeSaved = shareSaved(way.time.low, leastTime);
    verdict.errorSaved = shareSaved(way.error, leastError);
    return verdict;
}

std::string frontText(const std::vector<Way>& ways) {
    std::string names;
    for (const std::size_t n : frontOf(ways)) names += (names.empty() ? "" : ", ") + ways[n].name;
    if (names.empty()) return "Nothing was measured.";
    std::string text = "On the Pareto front, from the fastest: " + names + ".";
    for (std::size_t n = 0; n < ways.size(); ++n)
        if (ways[n].isDefault) text += " " + verdictText(ways[n], verdictOf(ways, n));
    return text;
}

}  // namespace stereonav
