// --noise: detail for a medium, by name or from a file. The file's format is in docs/formats.md.
#pragma once

#include <string>
#include <string_view>

#include "engine/medium/model/perturbation.h"

namespace stereonav {

// Returns the noise for --noise: "none", "cloud" or "fur" for a medium that is `extent` metres long, or that
// of a file. Throws Error.
Perturbation findNoise(const std::string& text, double extent);
// Reads a file's text. Throws Error with file and line.
Perturbation parseNoise(std::string_view text, const std::string& source);

}  // namespace stereonav
