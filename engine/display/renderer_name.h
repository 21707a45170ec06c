// Tells from a driver's name how it draws.
#pragma once

#include <string_view>

namespace stereonav {

// Returns whether this GL_RENDERER draws on the processor, by its name.
bool drawsInSoftware(std::string_view renderer);

}  // namespace stereonav
