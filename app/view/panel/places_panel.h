// Home, and places that the user has named: with pictures; a click flies there.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "app/view/asked_actions.h"
#include "app/view/bookmarks.h"
#include "app/view/kept_places.h"
#include "app/view/panel/panel_texture.h"

namespace stereonav {

class PlacesPanel {
public:
    void draw(KeptPlaces& kept, AskedActions& actions);
    void forget() { mPictures.clear(); }

private:
    void drawPlace(KeptPlaces& kept, Bookmarks& places, const Bookmark& place);

    std::map<std::string, PanelTexture> mPictures;  // by file
    std::string mRenaming, mName;
};

}  // namespace stereonav
