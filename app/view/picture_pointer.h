// The pointer on the picture, in the first window or in the small picture beside panels of their own: what
// lies under it, and what dragging, wheel and clicks do.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/view/frame_presenter.h"
#include "app/view/panel_stage.h"
#include "engine/scene/facts.h"

namespace stereonav {

class Instruments;
class Notices;

class PicturePointer {
public:
    // All of them outlive this.
    PicturePointer(std::optional<ViewSession>& session, Window& window, PanelStage& stage,
                   const FramePresenter& pictures)
        : mSession(session), mWindow(window), mStage(stage), mPictures(pictures) {}

    // Whether it is drawn at the depth of what it is over: where two eyes' pictures are shown, of which
    // slices have none.
    bool isOfPicture(const OutputModeInfo& mode) const;
    // Where it is over the picture: shares of an eye's size.
    std::optional<glm::dvec2> share(const OutputModeInfo& mode) const;
    // What is seen under it, of a picture that stands still.
    std::optional<glm::dvec3> world() const;
    Facts facts() const;  // of that place; none mostly

    // Takes what was done with it since the last turn.
    void use(Instruments& instruments, Notices& notices);

private:
    void useControls(Notices& notices);

    std::optional<ViewSession>& mSession;
    Window& mWindow;
    PanelStage& mStage;
    const FramePresenter& mPictures;
};

}  // namespace stereonav
