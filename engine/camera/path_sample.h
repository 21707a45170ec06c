// What every reader of paths checks at each sample, so that it can name the line or the keyframe.
#pragma once

#include <string>

#include "engine/camera/recorded_path.h"

namespace stereonav {

// Returns "" when `sample` may follow `before` (null: it is the first); else what was expected and found.
std::string sampleProblem(const PathSample* before, const PathSample& sample);

// The advice that goes with a problem of sampleProblem().
inline constexpr const char* kSampleAdvice =
    "give each pose finite numbers, a later time and a rotation that is not zero";

}  // namespace stereonav
