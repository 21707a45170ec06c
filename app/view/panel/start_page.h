// What a person sees first: the built-in scenes as pictures, files that were open before, and three hints.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "app/view/panel/panel_host.h"
#include "app/view/panel/panel_texture.h"

namespace stereonav {

class StartPage {
public:
    void show(bool shown);
    bool shown() const { return mShown; }
    // True: a file is to be looked for.
    bool draw(PanelHost& host);

    void forget() { mPictures.clear(); }  // what belongs to the window's context

private:
    bool drawRecentFile(PanelHost& host, const RecentFile& file, float width);
    void drawRecent(PanelHost& host, float width);
    PanelTexture* pictureOf(const RecentFile& file);

    bool mShown = false;
    std::map<std::string, PanelTexture> mPictures;  // of recent files, by their files
    std::filesystem::path mForget;                  // to be taken off the list
};

}  // namespace stereonav
