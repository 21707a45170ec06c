// What a person sees first: the built-in scenes as pictures, files that were open before, and three hints.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

class StartPage {
public:
    void show(bool shown) { mShown = shown; }
    bool shown() const { return mShown; }
    // True: a file is to be looked for.
    bool draw(PanelHost& host);

private:
    bool mShown = false;
};

}  // namespace stereonav
