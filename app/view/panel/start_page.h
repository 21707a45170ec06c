// What a person sees first: the built-in scenes as pictures, files that were open before, and three hints.
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
    // True: a file is to be looked for.
    bool draw(SceneChanges& changes, KeptPlaces& kept, FileLooks& looks);

    void forget() { mPictures.clear(); }  // what belongs to the window's context

private:
    bool drawRecentFile(FileLooks& looks, const RecentFile& file, float width);
    void drawRecent(SceneChanges& changes, KeptPlaces& kept, FileLooks& looks, float width);
    PanelTexture* pictureOf(const RecentFile& file);

    bool mShown = false;
    std::map<std::string, PanelTexture> mPictures;  // of recent files, by their files
    std::filesystem::path mForget;                  // to be taken off the list
};

}  // namespace stereonav
