// Error against time: which ways are worth taking, and whether the one that a program takes is among them.
// Times are judged by the least of their repeats: what else a machine does only ever adds.
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

// Returns the indices of the points that none beats (smaller or equal in both, smaller in one), by rising x.
std::vector<std::size_t> paretoFront(const std::vector<glm::dvec2>& points);

// Returns the indices of the ways that none beats, by rising time. Ways that were not measured are never
// among them.
std::vector<std::size_t> frontOf(const std::vector<Way>& ways);

// How a way stands to the front.
struct ParetoVerdict {
    bool onFront = false;
    // Not on the front, but nothing beats it by more than the spread of its time and kSameError of its error.
    bool withinNoise = false;
    // The ways that beat this one: the fastest, and the share of time it saves; the one with the least error,
    // and the share of error it saves. "" where none does.
    std::string faster, better;
    double timeSaved = 0, errorSaved = 0;  // shares, 0 to 1
};
constexpr double kSameError = 0.01;  // errors nearer to each other than this share count as the same

// ways[which] is one of them.
ParetoVerdict verdictOf(const std::vector<Way>& ways, std::size_t which);

// One sentence about the front, and one about each default.
std::string frontText(const std::vector<Way>& ways);

}  // namespace stereonav
