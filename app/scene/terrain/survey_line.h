// Lines and areas that a user names, as places on a ground.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/options/output_place.h"
#include "app/scene/terrain/survey_ground.h"

namespace stereonav {

// A line over the ground in one of three forms.
struct SurveyLine {
    std::vector<glm::dvec2> places;  // x, y in the elevation model's reference system; empty: not given
    std::string track, path;         // a GPX or GeoJSON file; a file of a flight
};

struct WorldLine {
    std::string name;
    bool closed = false;
    std::vector<glm::dvec2> world;  // two or more different places; three or more for areas
};

// Returns the files that are read, for messages.
std::vector<NamedPlace> inputsOf(const SurveyLine& line);

// Returns the line. Throws Error that names option or file where a place lies off the ground or all places
// are equal.
WorldLine lineOnGround(const SurveyGround& survey, const std::vector<glm::dvec2>& places, bool closed,
                       const char* option);
// Returns the lines of the form that was given.
std::vector<WorldLine> linesOnGround(const SurveyGround& survey, const SurveyLine& line);

}  // namespace stereonav
