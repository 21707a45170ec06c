// Refusal of options that depend on the Earth's air, sky or places where the ground lies on another body.
#pragma once

#include <string>

#include "engine/math/earth_bend.h"

namespace stereonav {

// Throws Error that names `what`, an option or a file, unless the ground lies on the Earth. does: the reason,
// "is of longitudes on the Earth".
void expectEarth(const Body& body, const std::string& what, const std::string& does);

}  // namespace stereonav
