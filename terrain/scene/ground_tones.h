// Palettes of ground that no picture lies on, behind one question: the colour of a place.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "terrain/ground/heightfield.h"
#include "terrain/scene/ground_tint.h"

namespace stereonav {

// A place's colour without light, and how it lies.
struct GroundTone {
    glm::vec3 color;    // linear
    glm::dvec3 normal;  // unit
};

class GroundTones {
public:
    virtual ~GroundTones() = default;
    // height: metres as the ground has them, NaN in holes. From any thread.
    virtual GroundTone at(const glm::dvec2& grid, double height) const = 0;
};

// Bytes that a palette keeps for each sample, at most.
constexpr double kBytesOfTones = 16;

// Returns the palette place.palette. Both grounds must outlive it; place: the whole's.
std::unique_ptr<GroundTones> groundTones(const Heightfield& part, const TintPlace& place,
                                         const Heightfield& whole);

// Returns words for a palette: "natural colours by ...".
std::string describePalette(const TintPlace& place);

}  // namespace stereonav
