// How a volume's surface and inside look. The light is a lamp at the head, midway between the eyes, as an
// endoscope's: it moves with the viewer and both eyes see what one lamp lights.
#pragma once

#include <glm/vec3.hpp>

#include "engine/volume/transfer_function.h"

namespace stereonav {

struct VolumeLook {
    glm::vec3 surface{0.75f, 0.42f, 0.34f};  // linear RGB albedo
    glm::vec3 background{0.0f};              // linear RGB where nothing is hit
    float ambient = 0.08f;                   // light from everywhere, share of the lamp's at distance 0
    float diffuse = 0.92f;
    float specular = 0.18f, shininess = 24.0f;  // Blinn-Phong
    // The lamp's light falls off as 1 / (1 + (d / falloff)^2); 0: does not fall off. Metres.
    float falloff = 0.06f;
    TransferFunction transfer;  // empty: the opaque surface alone
};

}  // namespace stereonav
