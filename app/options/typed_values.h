// Conversion of values that were read and checked to the types of the program.
#pragma once

#include <glm/vec3.hpp>

#include "app/options/option_types.h"
#include "app/options/option_value.h"
#include "engine/camera/pose.h"
#include "engine/volume/volume_up.h"

namespace stereonav {

// A size of memory: "2G", "500M" or bytes, at least 10 MB. Any other text has a problem, and 0 bytes.
std::optional<ValueProblem> problemOfMemory(const std::string& text);
double bytesOfMemoryText(const std::string& text);

// Returns the enumerator at the index that a Word has in its list.
template <typename Enum>
Enum choiceOf(const OptionValue& value) {
    return static_cast<Enum>(value.choice);
}

// Returns a colour from one number for all three channels, or from three.
glm::dvec3 colorOf(const OptionValue& value);
glm::dvec3 placeOf(const OptionValue& value);
LightPlace lightPlaceOf(const OptionValue& value);
Pose poseOf(const OptionValue& value);
LampsAsked lampsOf(const OptionValue& value);
LightChoice lightChoiceOf(const OptionValue& value);
UpAxis upAxisOf(const OptionValue& value);

}  // namespace stereonav
