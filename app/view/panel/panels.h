// The whole interface: menu bar, panels at both sides, status bar; which of them are open, and how wide.
// Where there is no room for panels beside the picture they are drawers over it.
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

    // Lays out the interface once; to be called inside Interface::layOut.
    void draw(const PanelParts& parts);

    // The part that is left for the picture in the last layout, in units of the interface: corner and size.
    struct Rest {
        glm::vec2 corner{0}, size{0};
        float top = 0, bottom = 0;  // heights of its parts that menu bar and status bar cover
    };
    Rest rest(const glm::vec2& whole) const;

    void toggleAll();  // hides everything, or shows it again
    bool hidden() const;
    void toggleSide();      // panels at the right
    void toggleLeft();      // places, map, slices
    void showFindings();    // one of the panels at the right
    void toggleUnfolded();  // the unfolded wall, below the picture
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
    void setFolder(const std::filesystem::path& folder);  // folder for choosing files
    const std::filesystem::path& folder() const;
    void forget();  // frees objects of the window's context, which has to exist

    // Closes the topmost open element; returns false where there is none.
    bool closeOne();

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
