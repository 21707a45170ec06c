// A medium with everything needed to show it, made from options or from another kind of scene.
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

// A scene, immutable except for the look, which changes between frames.
struct MediumScene {
    Medium medium;
    MediumLook look;
    SweepSetting sweep;
    // Returns the linear RGB of the background in a unit world direction; empty: look.background.
    std::function<glm::vec3(const glm::dvec3& direction)> sky;

    // Returns the medium with surface weight 1 everywhere, which the surface model (eq. 2) shades.
    std::function<Medium()> makeSurface;

    std::string transfer, phase = "none", noise = "none";  // by name, for `info`
    std::vector<std::string> notes;
    ToneCurve tone;  // tone curve from the light of medium and background to the picture

    bool animated() const {
        for (const NoiseScale& scale : medium.perturbation().scales)
            if (scale.velocity != glm::dvec3(0.0)) return true;
        return false;
    }
    // Sets the direction of parallel light, radians: clockwise from north, above the horizon.
    void turnLight(double azimuth, double elevation);
};

// Return the same functions with surface weight 1.
MediumTransfer allSurface(const MediumTransfer& transfer);
Medium allSurface(const Medium& layers);  // layers: without a grid

}  // namespace stereonav
