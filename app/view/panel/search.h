// Find anything: options, commands and modes by words, each with its key and its present value, set there.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

class SearchBox {
public:
    void open() { mOpen = mFresh = true; }
    void close() { mOpen = false; }
    bool isOpen() const { return mOpen; }
    void draw(PanelHost& host);

private:
    bool mOpen = false, mFresh = false;
    std::string mWords;
    int mChosen = 0;
};

}  // namespace stereonav
