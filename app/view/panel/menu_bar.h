// The menu bar.
#pragma once

#include "app/view/panel/panel_parts.h"

namespace stereonav {

// Parts of the interface that menus switch.
struct MenuWishes {
    bool openFile = false, saveScene = false, start = false, search = false, help = false, hideAll = false;
    bool openOther = false;                 // opens another study beside this one
    bool other = false;                     // whether there can be another study
    bool movie = false, picture = false;    // opens the panel for a movie, for a picture
    bool *side = nullptr, *left = nullptr;  // panels at the right; places, map and slices
    bool* unfolded = nullptr;               // the unfolded wall; null: the scene has none
};

// Draws the bar and returns its height in units of the interface.
float drawMenuBar(const PanelParts& parts, MenuWishes& wishes);

}  // namespace stereonav
