// Home, and places that a person named: with pictures, flown to by a click.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "app/view/bookmarks.h"
#include "app/view/panel/panel_host.h"
#include "app/view/panel/panel_texture.h"

namespace stereonav {

class PlacesPanel {
public:
    void draw(PanelHost& host);
    void forget() { mPictures.clear(); }

private:
    void drawPlace(PanelHost& host, Bookmarks& places, const Bookmark& place);

    std::map<std::string, PanelTexture> mPictures;  // by their files
    std::string mRenaming, mName;
};

}  // namespace stereonav
