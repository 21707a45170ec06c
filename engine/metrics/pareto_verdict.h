// Error against time: which ways are on the Pareto front, and whether the program's default is one of them.
// The time of a way is the least of its repeats, since other programs can only add to it.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/metrics/spread.h"

namespace stereonav {

struct Way {
    std::string name;
    Spread time;       // >= 0
    double error = 0;  // >= 0
    bool isDefault = false;
};

// Returns the indices of the Pareto front: points that no other point beats (smaller or equal in both,
// smaller in one), by rising x.
std::vector<std::size_t> paretoFront(const std::vector<glm::dvec2>& points);

// Returns the indices of the ways on the Pareto front, by rising time. Ways that were not measured are left
// out.
std::vector<std::size_t> frontOf(const std::vector<Way>& ways);

// Whether a way is on the Pareto front, and which ways beat it.
struct ParetoVerdict {
    bool onFront = false;
    // The way is not on the front, but within noise of it: no way that beats it differs by more than the
    // spread of its time and kSameError of its error.
    bool withinNoise = false;
    // The ways that beat this one: the fastest, and the share of time it saves; the one with the least error,
    // and the share of error it saves. "" where none does.
    std::string faster, better;
    double timeSaved = 0, errorSaved = 0;  // shares, 0 to 1
};
constexpr double kSameError = 0.01;  // errors nearer to each other than this share count as the same

// Returns the verdict on ways[which]. Among `ways` are all ways to compare it with, and itself.
ParetoVerdict verdictOf(const std::vector<Way>& ways, std::size_t which);

// One sentence about the front, and one about each default.
std::string frontText(const std::vector<Way>& ways);

}  // namespace stereonav
