// Pieces of a volume that somebody chose by a place in them, against what was found.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace stereonav {

// Places in the world, metres.
struct PieceChoices {
    std::vector<glm::dvec3> include, exclude;

    bool operator==(const PieceChoices&) const = default;
    bool empty() const { return include.empty() && exclude.empty(); }
};

}  // namespace stereonav
