// The other study beside the eye: its wall from the matching place, looking the matching way.
#pragma once

#include <memory>

#include "app/view/panel/panel_host.h"
#include "app/view/panel/panel_texture.h"
#include "app/view/second_study.h"

namespace stereonav {

class SecondPanel {
public:
    static bool has(PanelHost& host);  // whether the scene has a line to match
    // True: another study is to be chosen.
    bool draw(PanelHost& host);
    void forget();  // what belongs to the window's context

private:
    void drawPicture(PanelHost& host, SecondStudy& second);

    PanelTexture mTexture;
    std::shared_ptr<const SecondPicture> mShown;  // the texture's
};

}  // namespace stereonav
