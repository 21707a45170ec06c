// Which parts of the interface are shown, how wide its columns are, and what the last layout left for the
// picture.
#pragma once

#include <glm/vec2.hpp>

namespace stereonav {

struct ShownPanels {
    // A column of panels at one side of the picture.
    struct Column {
        bool shown = false;
        float width = 22;  // multiples of a letter's height
        float taken = 0;   // width in the last layout, in units of the interface
    };
    // The part that is left for the picture, in units of the interface: corner and size.
    struct Rest {
        glm::vec2 corner{0}, size{0};
        float top = 0, bottom = 0;  // heights of its parts that menu bar and status bar cover
    };

    void toggleSide();
    void toggleLeft();
    void toggleUnfolded();
    Rest rest(const glm::vec2& whole) const;

    bool hidden = false;  // everything but the picture
    bool help = false, start = false;
    bool placeNames = true;  // names of places over the picture
    bool figures = false;    // times, ages and errors in the status bar, in place of words
    Column left;             // places, map, slices
    Column side;             // panels at the right
    bool unfolded = false;   // the unfolded wall, a strip below the picture
    // Sizes in the last layout, in units of the interface.
    bool beside = true;                     // whether columns take their room from the picture
    float above = 0, below = 0, strip = 0;  // heights of menu bar, status bar and strip
};

}  // namespace stereonav
