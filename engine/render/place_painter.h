// What paints surfaces in eyes' pictures (eye_painter.h), for one place: where a picture is drawn that no eye
// sees.
#pragma once

#include <glm/vec3.hpp>

namespace stereonav {

class PlacePainter {
public:
    virtual ~PlacePainter() = default;
    // Of this colour, linear RGB, at a place of the surface, world, metres. From many threads, not while what
    // it paints is being changed.
    virtual glm::vec3 paintPlace(const glm::dvec3& world, const glm::vec3& color) const = 0;
};

}  // namespace stereonav
