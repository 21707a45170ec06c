// The other study beside the eye: its wall from the matching place, in the matching direction.
#pragma once

#include <memory>

#include "app/view/panel/panel_texture.h"
#include "app/view/second_side.h"
#include "app/view/second_study.h"

namespace stereonav {

class SecondPanel {
public:
    static bool has(const ViewSession* session);  // whether the scene has a line to match
    // Draws the panel; returns true where another study is to be chosen.
    bool draw(SecondSide& side, const ViewSession& session, bool loading);
    void forget();  // frees objects of the window's context

private:
    void drawPicture(SecondSide& side, const ViewSession& session, bool loading);

    PanelTexture mTexture;
    std::shared_ptr<const SecondPicture> mShown;  // picture in the texture
};

}  // namespace stereonav
