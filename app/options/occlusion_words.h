// Values of --ambient-method: "gaussian", "t-beta", "t-beta B", "drawn-in", "drawn-in S", "chebyshev".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/option_value.h"
#include "engine/light/occlusion/occlusion.h"

namespace stereonav {

// Returns the estimate that the text names; empty for any other text.
std::optional<OcclusionEstimate> occlusionEstimateFromText(const std::string& text);
// Returns what is wrong with such a text; empty where nothing is.
std::optional<ValueProblem> problemOfOcclusionText(const std::string& text);
// Returns the text for an estimate; numbers that have their default are left out.
std::string textOf(const OcclusionEstimate& estimate);
// Returns the names for help, with the numbers that may follow them.
std::string occlusionMethodNames();
std::vector<std::string> occlusionMethodWords();  // the names alone

}  // namespace stereonav
