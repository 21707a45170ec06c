// Checks of one sample of a path, for every reader of paths, so that messages can name the line or the
// keyframe.
#pragma once

#include <string>

#include "engine/camera/recorded_path.h"

namespace stereonav {

// Returns "" if `sample` may follow `before` (null: it is the first); else a message of what was expected and
// found.
std::string sampleProblem(const PathSample* before, const PathSample& sample);

// Advice for problems that sampleProblem() reports.
inline constexpr const char* kSampleAdvice =
    "give each pose finite numbers, a later time and a rotation that is not zero";

}  // namespace stereonav
