// The menu bar.
#pragma once

#include <optional>
#include <string>

#include "app/view/panel/file_browser.h"
#include "app/view/panel/panel_parts.h"
#include "app/view/panel/shown_panels.h"

namespace stereonav {

// Requests from the menus, other than for panels to be shown.
struct MenuWishes {
    std::optional<FileBrowser::For> open;
    std::string exports, exportName;      // the command that makes a file, and its first name; "": none
    bool search = false, place = false;   // opens the search box, or that for a place
    bool movie = false, picture = false;  // opens the panel for a movie, for a picture
};

// Draws the bar and returns its height in units of the interface.
float drawMenuBar(const PanelParts& parts, ShownPanels& shown, MenuWishes& wishes);

}  // namespace stereonav
