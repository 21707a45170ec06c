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
    void show(bool shown);
    bool shown() const { return mShown; }
    // Draws the page; returns true where a file is to be chosen.
    bool draw(SceneChanges& changes, KeptPlaces& kept, FileLooks& looks);

    void forget() { mPictures.clear(); }  // frees objects of the window's context

private:
    bool drawRecentFile(FileLooks& looks, const RecentFile& file, float width);
    void drawRecent(SceneChanges& changes, KeptPlaces& kept, FileLooks& looks, float width);
    PanelTexture* pictureOf(const RecentFile& file);

    bool mShown = false;
    std::map<std::string, PanelTexture> mPictures;  // pictures of recent files, by file
    std::filesystem::path mForget;                  // file to remove from the list
};

}  // namespace stereonav
