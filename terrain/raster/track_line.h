// A line or an area from a GPX or GeoJSON file.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace stereonav {

struct TrackLine {
    std::string name;  // "" where the file has none
    bool closed = false;
    // Longitude and latitude, WGS 84; a closed line does not repeat its first place.
    std::vector<glm::dvec2> degrees;
    int feature = 0;  // the same for all segments of one track, and for all parts of one drawing
};

struct TrackPlace {
    std::string name;         // "" where the file has none
    glm::dvec2 degrees{0.0};  // longitude, latitude of WGS 84
};

// Joins the segments of each feature into one line, straight from the end of each to the beginning of the
// next. Areas are not joined.
std::vector<TrackLine> joinedSegments(std::vector<TrackLine> lines);

struct TrackFile {
    std::vector<TrackLine> lines;
    std::vector<TrackPlace> places;  // waypoints, and single points of drawings
};

}  // namespace stereonav
