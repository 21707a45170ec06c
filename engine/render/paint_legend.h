// What the colours mean that a scene's surfaces are painted in.
#pragma once

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

// A capability of scenes (engine/scene/capabilities.h).
struct PaintLegend {
    std::vector<Legend> legends;
    std::vector<std::string> notes;  // of what could not be painted, a sentence each
};

}  // namespace stereonav
