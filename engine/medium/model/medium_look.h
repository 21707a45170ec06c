// How a medium is lit and shaded: the light, the model (row K9 of docs/ledger.md), the phase function and the
// background.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string_view>

#include "engine/medium/model/phase_function.h"
#include "engine/volume/volume_look.h"

namespace stereonav {

struct MediumLight {
    enum class Kind {
        Parallel,  // a sun: travels along `direction`
        Lamp       // a lamp at a place, shining into a cone about `direction`
    };
    Kind kind = Kind::Parallel;
    glm::dvec3 direction{0, 0, -1};  // direction in which the light travels, unit, world
    glm::dvec3 position{0.0};        // Lamp: world, metres
    // Lamp that moves with the viewer: at the head (position is not read), shining along the view.
    bool atHead = false;
    double coneAngle = 2.0;  // Lamp: radians, the full angle, below 2.8; beyond it there is no light
    double falloff = 0;      // Lamp: light falls as 1 / (1 + (d / falloff)^2); 0: not at all; metres
    // Linear RGB, L_l of eq. 12: radiance that an isotropic thin medium of colour 1 sends per optical depth.
    // A parallel light with irradiance H across its direction has H / (4 pi).
    glm::vec3 radiance{1.0f};
};

enum class MediumModel {
    Emission,  // eq. 4: the colour is emitted, no light
    Surface,   // eq. 2: Blinn-Phong with the gradient as normal, unshadowed
    Direct,    // eq. 5: attenuated light
    Indirect   // attenuated light as in Direct, and scattered light that travels on in a cone (eq. 10 to 12)
};

struct MediumLook {
    MediumModel model = MediumModel::Indirect;
    MediumLight light;
    PhaseFunction phase;         // how direct light is scattered
    float indirectShare = 1;     // factor, 0 or more, on scattered light in the picture
    glm::vec3 background{0.0f};  // linear RGB
    // Blinn-Phong, weighted by S: shares of the light for ambient, diffuse and highlight, and the highlight's
    // exponent.
    float ambient = 0.1f, diffuse = 0.9f, specular = 0.2f, shininess = 32.0f;
    // Baked light (irradiance / pi), which replaces Blinn-Phong where the surface weight is above 0 and a
    // texel is known.
    BakedLook baked;
};

std::string_view nameOf(MediumModel model);  // emission, surface, direct, indirect

}  // namespace stereonav
