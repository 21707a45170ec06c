// How a scene is shown as a medium that light goes through.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "app/options/option_types.h"
#include "engine/medium/model/medium_look.h"

namespace stereonav {

struct MediumOptions {
    std::string medium;                   // preset, file or "ground"; "": none, or a built-in medium's own
    std::optional<MediumModel> model;     // empty: indirect
    std::string phase;                    // name of a phase function; "": none
    std::optional<LightPlace> lightFrom;  // where parallel light comes from
    std::optional<LampChoice> lamp;       // empty: the scene's own
    std::optional<glm::vec3> lightColor;  // linear
    std::string noise;                    // file, cloud, fur or none; "": the scene's own
    std::optional<Mist> mist;             // mist over a terrain
    std::optional<int> slices, lightSize;
    std::optional<double> cone_deg;      // angle in which scattered light spreads
    std::optional<double> shadingWidth;  // voxels between the places where surfaces are shaded

    // Returns whether the medium is a terrain's ground in its own colours.
    bool ground() const { return medium == "ground"; }
};

}  // namespace stereonav
