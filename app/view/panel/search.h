// Search for options, commands and modes by words; each is shown with its key and value, and can be set
// there.
#pragma once

#include <optional>

#include "app/view/asked_actions.h"
#include "app/view/panel/place_row.h"
#include "app/view/scene_changes.h"
#include "app/view/search_hits.h"

namespace stereonav {

class SearchBox {
public:
    void open() {
        mOpen = mFresh = true;
        mForPlace = false;
    }
    // Opens it for a place alone: other words find nothing.
    void openForPlace() {
        open();
        mForPlace = true;
    }
    void close() { mOpen = false; }
    bool isOpen() const { return mOpen; }
    void draw(SceneChanges& changes, AskedActions& actions, ViewSession* session);

private:
    bool drawPlace(ViewSession* session, bool entered);
    const std::vector<SearchHit>& hits();

    bool mOpen = false, mFresh = false, mWrites = false;  // mWrites: the words get the keyboard again
    bool mForPlace = false;
    PlaceRow mPlace;
    std::string mWords;
    std::optional<std::string> mSearched;  // words that mHits answer
    std::vector<SearchHit> mHits;
    int mChosen = 0;
};

}  // namespace stereonav
