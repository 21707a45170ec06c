// Draws the window: the picture in its mode with everything over it. Draws only when something has changed,
// because ray casting needs the CPU.
#pragma once

#include <functional>

#include "app/view/frame_presenter.h"
#include "app/view/view_display.h"
#include "app/view/window/panel_stage.h"
#include "app/view/window/picture_marks.h"
#include "app/view/window/picture_pointer.h"
#include "app/view/window/window_times.h"
#include "engine/base/stopwatch.h"

namespace stereonav {

class WindowDrawing {
public:
    // The arguments must outlive this object.
    WindowDrawing(std::optional<ViewSession>& session, Window& window, ViewDisplay& display,
                  PanelStage& stage, FramePresenter& pictures, const PicturePointer& pointer,
                  PictureMarks& marks);

    // Draws in one turn of the window's loop. turn: a stopwatch started when the turn began; dt: seconds that
    // the last turn took; busy: something is being loaded; drawPanels: lays out the panels. Returns true
    // where the window was drawn.
    bool draw(const Stopwatch& turn, double dt, bool busy, const std::function<void()>& drawPanels);

private:
    ComposeSetting setting() const;
    void show(const ComposeSetting& setting);

    std::optional<ViewSession>& mSession;
    Window& mWindow;
    ViewDisplay& mDisplay;
    PanelStage& mStage;
    FramePresenter& mPictures;
    const PicturePointer& mPointer;
    PictureMarks& mMarks;
    ComposeSetting mDrawn;
    PicturePlace mPlace;  // place of the picture that was drawn
    WindowTimes mTimes;
};

}  // namespace stereonav
