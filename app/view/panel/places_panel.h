// Home, and places that a person named: with pictures, flown to by a click.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "app/view/bookmarks.h"
#include "app/view/kept_places.h"
#include "app/view/panel/panel_texture.h"
#include "app/view/window_input.h"

namespace stereonav {

class PlacesPanel {
public:
    void draw(KeptPlaces& kept, AskedActions& actions);
    void forget() { mPictures.clear(); }

private:
    void drawPlace(KeptPlaces& kept, Bookmarks& places, const Bookmark& place);

    std::map<std::string, PanelTexture> mPictures;  // by their files
    std::string mRenaming, mName;
};

}  // namespace stereonav
