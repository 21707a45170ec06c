// Options of `measure` and `profile`: a line or an area over the ground, and the files to write.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/options/command.h"
#include "app/scene/terrain/survey_line.h"

namespace stereonav {

struct GroundLineOptions {
    SceneOptions scene;
    Telling telling;
    SurveyLine line;
    std::vector<glm::dvec2> area;   // corners, in the coordinates of the line's places
    std::optional<double> plane_m;  // height that volumes refer to; empty: the area's lowest corner
    std::string csv, geojson, svg;  // files; "": none
};

std::vector<Option> groundLineOptions();

}  // namespace stereonav
