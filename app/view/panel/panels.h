// The whole interface: menu bar, panels at both sides, status bar. Where there is no room for panels beside
// the picture they are drawers over it.
#pragma once

#include <filesystem>
#include <memory>

#include "app/view/panel/file_browser.h"
#include "app/view/panel/panel_parts.h"
#include "app/view/panel/shown_panels.h"

namespace stereonav {

enum class ViewCommand;

class Panels {
public:
    Panels();
    ~Panels();

    // Lays out the interface once; to be called inside Interface::layOut.
    void draw(const PanelParts& parts);

    ShownPanels& shown();
    const ShownPanels& shown() const;
    void showFindings();  // one of the panels at the left
    void openSearch();
    void openPlace();                // the same for a place alone
    bool open(ViewCommand command);  // commands that open a panel, and only that; false for others
    void openFiles(FileBrowser::For what);
    void setFolder(const std::filesystem::path& folder);  // folder for choosing files
    const std::filesystem::path& folder() const;
    void forget();  // frees objects of the window's context, which has to exist

    // Closes the topmost open element; returns false where there is none.
    bool closeOne();
    // Returns whether a box is open that all keys belong to.
    bool holdsKeys() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
