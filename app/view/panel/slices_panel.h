// Three slices through a study, linked at one place: that of the eye in flight, or of a click.
#pragma once

#include <array>
#include <memory>

#include "app/view/instruments.h"
#include "app/view/panel/panel_texture.h"
#include "app/view/slice_picture.h"
#include "engine/scene/slices.h"

namespace stereonav {

class SlicesPanel {
public:
    void draw(ViewSession& session, StudyReading& reading, Instruments& instruments);
    void forget();
    // Moves the slices to a place and keeps them there.
    void show(const glm::dvec3& place) { mFollows = false, mCross = place; }

private:
    struct View {
        PanelTexture texture;
        glm::dvec3 cross{0.0}, eye{0.0};  // places that it was drawn with
        int width = 0, height = 0, slice = -1;
        double zoom = 0;
        double window = 0, level = 0;
        bool follows = true;
        std::weak_ptr<const OpenScene> scene;  // scene whose lumen it shows
    };
    void drawView(ViewSession& session, Instruments& instruments, const SliceStudy& study, SliceAxis axis);
    void windowControls(const SliceStudy& study);

    std::weak_ptr<const SliceStudy> mStudy;
    std::array<View, 3> mViews;
    glm::dvec3 mCross{0.0};
    bool mFollows = true;  // whether the cross follows the eye
    double mWindow = 1500, mLevel = -200, mZoom = 1;
};

}  // namespace stereonav
