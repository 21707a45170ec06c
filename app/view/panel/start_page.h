// The first page: the built-in scenes as pictures, recent files, and three hints.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "app/view/file_looks.h"
#include "app/view/kept_places.h"
#include "app/view/panel/panel_texture.h"
#include "app/view/scene_changes.h"

namespace stereonav {

class StartPage {
public:
    // Draws the page; returns true where a file is to be chosen. shown: false once it is closed.
    bool draw(SceneChanges& changes, KeptPlaces& kept, FileLooks& looks, bool& shown);

    void forget() { mPictures.clear(); }  // frees objects of the window's context

private:
    bool drawRecentFile(FileLooks& looks, const RecentFile& file, float width);
    // Returns the file that was chosen; "": none.
    std::string drawRecent(KeptPlaces& kept, FileLooks& looks, float width);
    PanelTexture* pictureOf(const RecentFile& file);

    std::map<std::string, PanelTexture> mPictures;  // pictures of recent files, by file
    std::filesystem::path mForget;                  // file to remove from the list
};

}  // namespace stereonav
