// Names of visible places, as labels over both eyes' pictures.
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
    EyeMark mark;          // mark of the place
    std::string text;      // name, shortened where it is long
    glm::dvec2 textAt{0};  // top left corner of the text, pixels from the mark: the same for both eyes
};

// Returns the size of a text as it will be drawn, in pixels.
using TextSize = std::function<glm::dvec2(const std::string&)>;

// Returns labels, nearest first. A place has none where it would cover another label, does not fit into the
// picture, or would stand far in front of the screen, as the viewer has nearly reached it. margin: pixels
// kept around texts.
std::vector<PlaceLabel> labelsInView(const StereoViews& views, const Plane<float>& viewDepth,
                                     const std::vector<LabelledPlace>& places, const TextSize& sizeOf,
                                     double margin, const glm::ivec2& guard = glm::ivec2(0));

}  // namespace stereonav
