// The pointer on the picture, in the first window or in the small picture beside panels in their own window:
// the place under it, and the actions of dragging, wheel and clicks.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/view/frame_presenter.h"
#include "app/view/window/panel_stage.h"
#include "engine/scene/facts.h"

namespace stereonav {

class Instruments;
class Notices;
struct PointerDrag;

class PicturePointer {
public:
    // The arguments must outlive this object.
    PicturePointer(std::optional<ViewSession>& session, Window& window, PanelStage& stage,
                   const FramePresenter& pictures)
        : mSession(session), mWindow(window), mStage(stage), mPictures(pictures) {}

    // Returns whether the pointer is drawn at the depth of the place under it: for pictures of two eyes,
    // except slices.
    bool isOfPicture(const OutputModeInfo& mode) const;
    // Returns its place on the picture in shares of an eye's size.
    std::optional<glm::dvec2> share(const OutputModeInfo& mode) const;
    // Returns the place under the pointer in the world, for a picture that rests.
    std::optional<glm::dvec3> world() const;
    Facts facts() const;  // facts of that place, if any

    // Handles its actions since the last turn.
    void use(Instruments& instruments, Notices& notices);

private:
    void useControls(Notices& notices);
    // Handles a drag in a picture of this size in screen units. from: where it began, a share of the size.
    void useDrag(const PointerDrag& drag, const glm::dvec2& from, const glm::dvec2& size);
    // at: the pointer's place, a share of the picture's size; empty where it is not known.
    void useWheel(double notches, const std::optional<glm::dvec2>& at);
    // Returns the place that is seen there, also in a warped picture.
    std::optional<glm::dvec3> surfaceAt(const glm::dvec2& share) const;

    std::optional<ViewSession>& mSession;
    Window& mWindow;
    PanelStage& mStage;
    const FramePresenter& mPictures;
    std::optional<glm::dvec2> mZoomedAt;  // share where the wheel began to zoom
};

}  // namespace stereonav
