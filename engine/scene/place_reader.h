// Facts of a place on a scene's surface, for the line under the pointer.
#pragma once

#include <glm/vec3.hpp>

#include "engine/scene/facts.h"

namespace stereonav {

// A capability (capabilities.h).
class PlaceReader {
public:
    virtual ~PlaceReader() = default;
    // Returns facts of a place in the world at or near the surface, each with a label and a text so short
    // that all fit into one line. Empty where there is nothing. May be called from any thread; fast enough to
    // be called at each motion of the pointer.
    virtual Facts readPlace(const glm::dvec3& world) const = 0;
};

}  // namespace stereonav
