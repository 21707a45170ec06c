// --ambient-method: "gaussian", "t-beta", "t-beta B", "drawn-in", "drawn-in S", "chebyshev".
#pragma once

#include <optional>
#include <string>

#include "app/options/option_value.h"
#include "engine/light/occlusion/occlusion.h"

namespace stereonav {

// None for anything else.
std::optional<OcclusionEstimate> occlusionEstimateFromText(const std::string& text);
// What is wrong with such a text, where anything is.
std::optional<ValueProblem> problemOfOcclusionText(const std::string& text);
// The text that gives such an estimate: without numbers that are usual.
std::string textOf(const OcclusionEstimate& estimate);
// For help: with what may follow them.
std::string occlusionMethodNames();

}  // namespace stereonav
