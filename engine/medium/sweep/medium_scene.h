// A medium with all that showing it needs, from options or a scene of another kind.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "engine/image/tone_curve.h"
#include "engine/medium/model/medium.h"
#include "engine/medium/model/medium_look.h"
#include "engine/medium/sweep/sweep_setting.h"

namespace stereonav {

// A scene, immutable but for the look, which changes between frames.
struct MediumScene {
    Medium medium;
    MediumLook look;
    SweepSetting sweep;
    // Returns linear RGB of what lies behind, by a unit world direction; empty: look.background.
    std::function<glm::vec3(const glm::dvec3& direction)> sky;

    // The medium with the surface weight 1 everywhere: what the surface model (eq. 2) shades.
    std::function<Medium()> makeSurface;

    std::string transfer, phase = "none", noise = "none";  // by name, for `info`
    std::vector<std::string> notes;
    ToneCurve tone;  // from light, of the medium and of what lies behind, to the picture

    bool animated() const {
        for (const NoiseScale& scale : medium.perturbation().scales)
            if (scale.velocity != glm::dvec3(0.0)) return true;
        return false;
    }
    // Sets where parallel light comes from, radians: clockwise from north, above the horizon.
    void turnLight(double azimuth, double elevation);
};

// Return the same functions, but for the surface weight, which is 1.
MediumTransfer allSurface(const MediumTransfer& transfer);
Medium allSurface(const Medium& layers);  // layers: without a grid

}  // namespace stereonav
