// Facts of a place on a scene's surface, for the line under the pointer.
#pragma once

#include <glm/vec3.hpp>

#include "engine/scene/facts.h"

namespace stereonav {

// A capability (capabilities.h).
class PlaceReader {
public:
    virtual ~PlaceReader() = default;
    // Returns facts of a world place at or near the surface, with a label each, and texts that are short
    // enough for one line together. Returns nothing where nothing is there. From any thread; quick enough for
    // each motion of a pointer.
    virtual Facts readPlace(const glm::dvec3& world) const = 0;
};

}  // namespace stereonav
