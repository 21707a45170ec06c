// Painters over the surfaces of a finished picture: contour lines, tints of parts seen before. Each eye is
// painted by its own depths after it was made, so that paint is never warped, both eyes show it at the same
// places of the surface, and pictures without it cost nothing more.
#pragma once

#include <glm/vec3.hpp>

#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"

namespace stereonav {

class EyePainter {
public:
    virtual ~EyePainter() = default;
    // Changes image.color where image.viewDepth, of this view, hits a surface. The work inside runs on all
    // threads. Must not run while the painted data are being changed.
    virtual void paint(const EyeView& view, EyeImage& image) const = 0;
    // Returns `color`, linear RGB, as painted at a place of the surface, world, metres, for pictures that are
    // not an eye's view. Marks whose size is defined in pixels are left out. From many threads.
    virtual glm::vec3 paintPlace(const glm::dvec3& /*world*/, const glm::vec3& color) const { return color; }
};

}  // namespace stereonav
