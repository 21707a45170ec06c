// How a CT study or another volume is read and shown; what is not given is chosen from it.
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
    std::optional<std::string> series;  // the one of a folder with several: its number or UID
    std::optional<std::string> label;   // the one of a mask with several: its number or name
    std::vector<glm::dvec3> seeds;      // LPS, metres
    PieceChoices choices;               // pieces that are added to the colon or taken from it, LPS
    FluidChoice fluid = FluidChoice::Out;
    bool resample = false;    // mend uneven or tilted slices
    bool isosurface = false;  // seen from outside, without looking for a colon
    std::optional<double> isovalue;
    std::string transfer;           // a transfer function's file or name; "": none
    std::optional<double> opacity;  // share of light that a translucent wall takes a millimetre, in (0, 1]
    bool backwards = false;         // flown from the caecum
    std::optional<UpAxis> up;       // the file's axis that is to point up; none: z
    Shading shading = Shading::Lamp;
    std::optional<double> exposure;                      // factor on baked light; none: by its mean
    std::optional<double> ambient_mm;                    // radius of ambient occlusion; none: without
    OcclusionEstimate ambientMethod;                     // how that is estimated
    std::optional<double> ambientStrength, ambientLamp;  // k of it, and the lamp's share beside it
    Modulation modulate = Modulation::None;              // what opacity is modulated by
    std::optional<double> modulateRadius_mm;             // none: ambient_mm's, or ten voxels
    std::optional<double> modulateSigma;                 // none: chosen
    double turn_deg = 0;  // turn about the vertical of the sky over baked transfer
    double tilt_deg = 0;  // tilt of it before that: what lies north rises
    bool cache = true;

    bool skyMoved() const { return turn_deg != 0 || tilt_deg != 0; }
};

}  // namespace stereonav
