// Marks a scene that is an object seen from outside: hands expect to turn it.
#pragma once

#include <glm/vec3.hpp>

namespace stereonav {

// The object's bounds in the world, metres.
struct SeenFromOutside {
    glm::dvec3 low{0.0}, high{0.0};
};

}  // namespace stereonav
