#include "engine/camera/eye_view.h"

#include <glm/geometric.hpp>

namespace stereonav {

glm::dvec3 EyeView::project(const glm::dvec3& world) const {
    const glm::dvec3 d = world - eye;
    const double depth = glm::dot(d, forward);
    const double x = (glm::dot(d, right) / depth - xMin) / pixelWidth();
    const double y = (yMax - glm::dot(d, up) / depth) / pixelHeight();
    return {x, y, depth};
}

EyeView EyeView::supersampled(int factor) const {
    EyeView view = *this;
    view.width *= factor;
    view.height *= factor;
    return view;
}

}  // namespace stereonav
