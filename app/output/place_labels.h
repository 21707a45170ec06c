// The names of places that are in view, as labels over both eyes' pictures.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/output/eye_marks.h"

namespace stereonav {

struct LabelledPlace {
    std::string name;
    glm::dvec3 world{0};  // metres
};

struct PlaceLabel {
    EyeMark mark;          // the place
    std::string text;      // its name, cut where it is long
    glm::dvec2 textAt{0};  // the text's top left corner, pixels from the mark: the same for both eyes
};

// Of a text as it will be drawn, pixels.
using TextSize = std::function<glm::dvec2(const std::string&)>;

// Nearest first; none that would lie over another one, or that has no room in the picture. Places that would
// stand far before the screen have none: one is nearly there. margin: pixels kept around texts.
std::vector<PlaceLabel> labelsInView(const StereoViews& views, const Plane<float>& viewDepth,
                                     const std::vector<LabelledPlace>& places, const TextSize& sizeOf,
                                     double margin, const glm::ivec2& guard = glm::ivec2(0));

}  // namespace stereonav
