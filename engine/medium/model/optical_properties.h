// Optical properties of a participating medium at one point (Kniss et al. 2003, table 1 and eq. 7 to 11). The
// equations the whole room follows are in docs/volume_light.md.
#pragma once

#include <glm/vec3.hpp>

namespace stereonav {

struct OpticalProperties {
    float extinction = 0;   // tau: optical depth a metre, for the eye and for direct light
    glm::vec3 color{0.0f};  // E of eq. 11: share of the incoming light that is sent on, linear RGB 0..1
    glm::vec3 indirectExtinction{0.0f};  // tau_i of eq. 8: optical depth a metre of scattered light
    float surface = 0;                   // S of eq. 11: 0 only volume light, 1 only surface shading
    // Radiance that the medium itself emits where it is opaque, linear RGB, >= 0 and unbounded: each metre
    // adds extinction * glow.
    glm::vec3 glow{0.0f};
};

}  // namespace stereonav
