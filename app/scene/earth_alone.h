// What goes by the Earth's own air, sky and places, and so is of no use on another body.
#pragma once

#include <string>

#include "engine/math/earth_bend.h"

namespace stereonav {

// Throws Error naming `what`, an option or a file, unless the ground lies on the Earth. does: "is of
// longitudes on the Earth".
void expectEarth(const Body& body, const std::string& what, const std::string& does);

}  // namespace stereonav
