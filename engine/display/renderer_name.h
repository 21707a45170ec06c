// What a driver's name tells.
#pragma once

#include <string_view>

namespace stereonav {

// Whether this GL_RENDERER draws on the processor, by its name.
bool drawsInSoftware(std::string_view renderer);

}  // namespace stereonav
