// All of the interface: a bar of menus, panels at both sides, a line of figures; what is open, and how wide.
// At widths that have no room for panels beside the picture they are drawers over it.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>

#include "app/view/panel/panel_parts.h"

namespace stereonav {

class Panels {
public:
    Panels();
    ~Panels();

    // One layout; inside Interface::layOut.
    void draw(const PanelParts& parts);

    // What is left for the picture, in units of the interface: corner and size. Of the last layout.
    struct Rest {
        glm::vec2 corner{0}, size{0};
        float top = 0, bottom = 0;  // of it that lie under the menus and the line at the bottom
    };
    Rest rest(const glm::vec2& whole) const;

    void toggleAll();  // hides everything, or shows it again
    bool hidden() const;
    void toggleSide();      // panels at the right
    void toggleLeft();      // places, map, slices
    void showFindings();    // among them
    void toggleUnfolded();  // the wall laid flat, below the picture
    void openSearch();
    void openFiles();
    void openSave();
    void openPaths();
    void showStart(bool shown);
    bool startShown() const;
    void toggleHelp();
    void setSide(bool shown, float width);  // pixels at scale 1
    void setLeft(bool shown, float width);
    bool sideShown() const;
    bool leftShown() const;
    float sideWidth() const;
    float leftWidth() const;
    void setFolder(const std::filesystem::path& folder);  // where files are looked for
    const std::filesystem::path& folder() const;
    void forget();  // what belongs to the window's context, while it is there

    // Closes the topmost of what can be closed; false: there is nothing.
    bool closeOne();

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
