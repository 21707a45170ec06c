// A line or an area out of a file of places.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace stereonav {

struct TrackLine {
    std::string name;  // "" where the file has none
    bool closed = false;
    std::vector<glm::dvec2>
        degrees;  // longitude, latitude of WGS 84; of a closed one the first is not repeated
};

struct TrackPlace {
    std::string name;         // "" where the file has none
    glm::dvec2 degrees{0.0};  // as of a line
};

struct TrackFile {
    std::vector<TrackLine> lines;
    std::vector<TrackPlace> places;  // waypoints, and single points of drawings
};

}  // namespace stereonav
