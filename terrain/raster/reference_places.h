// Conversion of places in a terrain's world to the reference system of the file that it was read from.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

namespace stereonav {

// Places in the file's reference system, x, y in its units: metres, feet, or degrees (longitude first). For
// one thread at a time.
class ReferencePlaces {
public:
    virtual ~ReferencePlaces() = default;
    // Returns the place; empty where there is no conversion between the systems. world: x, y in metres.
    virtual std::optional<glm::dvec2> referenceAt(const glm::dvec2& world) const = 0;
    virtual std::optional<glm::dvec2> worldAt(const glm::dvec2& reference) const = 0;
};

}  // namespace stereonav
