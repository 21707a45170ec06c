// How a CT study or another volume is read and shown; what is not given is chosen from the study.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/options/option_types.h"
#include "engine/light/occlusion/occlusion.h"
#include "engine/volume/piece_choices.h"
#include "engine/volume/volume_up.h"

namespace stereonav {

struct VolumeOptions {
    std::optional<std::string> series;  // number or UID, for a folder with several series
    std::optional<std::string> label;   // number or name, for a mask with several labels
    std::vector<glm::dvec3> seeds;      // LPS, metres
    PieceChoices choices;               // pieces to add to the colon or to remove from it, LPS
    FluidChoice fluid = FluidChoice::Out;
    bool resample = false;    // resample uneven or tilted slices
    bool isosurface = false;  // show the surface from outside, without looking for a colon
    std::optional<double> isovalue;
    std::string transfer;                    // file or name of a transfer function; "": none
    std::optional<double> opacity;           // share of light that a translucent wall takes per mm, in (0, 1]
    std::optional<double> maskSmoothing_mm;  // along a mask's wall; empty: by chosenLook
    bool backwards = false;                  // fly from the caecum
    std::optional<UpAxis> up;                // axis of the file that points up; empty: z
    Shading shading = Shading::Lamp;
    std::optional<double> exposure;                      // factor on baked light; empty: by the light's mean
    std::optional<double> ambient_mm;                    // radius of ambient occlusion; empty: none
    OcclusionEstimate ambientMethod;                     // how ambient occlusion is estimated
    std::optional<double> ambientStrength, ambientLamp;  // k of the occlusion, and the lamp's share
    Modulation modulate = Modulation::None;              // what opacity is modulated by
    std::optional<double> modulateRadius_mm;             // empty: ambient_mm, or ten voxels
    std::optional<double> modulateSigma;                 // empty: chosen
    double turn_deg = 0;  // turn about the vertical of the sky over baked transfer
    double tilt_deg = 0;  // tilt of the sky before the turn: what lies north rises
    bool cache = true;

    bool skyMoved() const { return turn_deg != 0 || tilt_deg != 0; }
};

}  // namespace stereonav
