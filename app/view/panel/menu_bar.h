// The bar of menus on top.
#pragma once

#include "app/view/panel/panel_parts.h"

namespace stereonav {

// What menus switch of the interface itself.
struct MenuWishes {
    bool openFile = false, saveScene = false, start = false, search = false, help = false, hideAll = false;
    bool openOther = false;                 // another study beside this one
    bool other = false;                     // whether there can be one
    bool movie = false, picture = false;    // their panels are opened
    bool *side = nullptr, *left = nullptr;  // panels at the right; places, map and slices
    bool* unfolded = nullptr;               // the wall laid flat; null: the scene has none
};

// Its height in units of the interface.
float drawMenuBar(const PanelParts& parts, MenuWishes& wishes);

}  // namespace stereonav
