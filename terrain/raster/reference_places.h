// Where places of a terrain's world lie in the reference system of the file that it was read from.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

namespace stereonav {

// Places in the file's reference system, x, y as it has them: metres, feet, or degrees (longitude first).
// From one thread at a time.
class ReferencePlaces {
public:
    virtual ~ReferencePlaces() = default;
    // Returns nothing where the systems have no such place. world: x, y in metres.
    virtual std::optional<glm::dvec2> referenceAt(const glm::dvec2& world) const = 0;
    virtual std::optional<glm::dvec2> worldAt(const glm::dvec2& reference) const = 0;
};

}  // namespace stereonav
