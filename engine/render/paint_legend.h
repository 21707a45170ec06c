// The legend of the colours that a scene's surfaces are painted in, and the names of painted places and
// lines.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace stereonav {

struct LegendEntry {
    glm::vec3 color{0.0f};  // linear, as painted on level ground
    std::string text;       // "5 to 10 degrees"
};

struct Legend {
    std::string title;  // "slope"
    std::vector<LegendEntry> entries;
};

// A place that is marked on the surface: world, metres.
struct PaintedPlace {
    std::string name;       // "" where it has none
    glm::dvec3 world{0.0};  // metres
};

// A line that is drawn on the surface, or an area's border, which does not repeat its first place.
struct PaintedLine {
    std::string name;  // "" where it has none
    bool closed = false;
    std::vector<glm::dvec2> world;  // x, y in metres; may include places outside the surface
};

// The legends, notes, places and lines of a scene: a capability (engine/scene/capabilities.h).
struct PaintLegend {
    std::vector<Legend> legends;
    std::vector<std::string> notes;  // what could not be painted, a sentence each
    std::vector<PaintedPlace> places;
    std::vector<PaintedLine> lines;
};

}  // namespace stereonav
