// Luminance of linear RGB with the primaries of ITU-R BT.709.
#pragma once

#include <glm/vec3.hpp>

namespace stereonav {

inline float luminance(const glm::vec3& c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}
inline double luminance(const glm::dvec3& c) {
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

}  // namespace stereonav
