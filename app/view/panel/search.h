// Search for options, commands and modes by words; each is shown with its key and value, and can be set
// there.
#pragma once

#include "app/view/asked_actions.h"
#include "app/view/scene_changes.h"

namespace stereonav {

class SearchBox {
public:
    void open() { mOpen = mFresh = true; }
    void close() { mOpen = false; }
    bool isOpen() const { return mOpen; }
    void draw(SceneChanges& changes, AskedActions& actions);

private:
    bool mOpen = false, mFresh = false, mWrites = false;  // mWrites: the words get the keyboard again
    std::string mWords;
    int mChosen = 0;
};

}  // namespace stereonav
