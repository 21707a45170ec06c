// Lines and areas that a user names, as places of a ground.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/options/output_place.h"
#include "app/scene/survey_ground.h"

namespace stereonav {

// A line over the ground as it is named: one of the three.
struct SurveyLine {
    std::vector<glm::dvec2> places;  // x, y in the reference system of the elevation model; empty: not given
    std::string track, path;         // a GPX or GeoJSON file; a recorded flight
};

struct WorldLine {
    std::string name;
    bool closed = false;
    std::vector<glm::dvec2> world;  // two places or more that differ, of areas three
};

// Files that are read, for messages.
std::vector<NamedPlace> inputsOf(const SurveyLine& line);

// Throws Error, naming option or file, where a place lies off the ground, or all are the same one.
WorldLine lineOnGround(const SurveyGround& survey, const std::vector<glm::dvec2>& places, bool closed,
                       const char* option);
// Those of the given one of the three ways.
std::vector<WorldLine> linesOnGround(const SurveyGround& survey, const SurveyLine& line);

}  // namespace stereonav
