#include "app/view/window/window_drawing.h"

#include <epoxy/gl.h>

#include "app/output/stereo_frame.h"

namespace stereonav {

WindowDrawing::WindowDrawing(std::optional<ViewSession>& session, Window& window, ViewDisplay& display,
                             PanelStage& stage, FramePresenter& pictures, const PicturePointer& pointer,
                             PictureMarks& marks)
    : mSession(session),
      mWindow(window),
      mDisplay(display),
      mStage(stage),
      mPictures(pictures),
      mPointer(pointer),
      mMarks(marks) {}

// Returns the session's mode; until there is a picture made for it, the mode of the one that is shown.
ComposeSetting WindowDrawing::setting() const {
    ComposeSetting setting =
        mSession ? mSession->compose() : ComposeSetting{mDisplay.mode().shown(), false, false};
    const ShownPicture& picture = mPictures.picture();
    if (!mSession || mSession->slices().shown() || !picture.left) return setting;
    const OutputModeInfo &now = infoOf(setting.mode), &then = infoOf(picture.of.mode);
    const SizeOption wanted = eyeSizeAt(now, mStage.placeOf(now)),
                     made = eyeSizeAt(then, mStage.placeOf(then));
    if (wanted.width != made.width || wanted.height != made.height) setting.mode = picture.of.mode;
    return setting;
}

bool WindowDrawing::draw(const Stopwatch& turn, double dt, bool busy,
                         const std::function<void()>& drawPanels) {
    const ComposeSetting setting = this->setting();
    const OutputModeInfo& mode = infoOf(setting.mode);
    Interface& interface = mStage.overPicture();
    InterfaceLook look = interface.look();
    look.grey = mode.layout == OutputLayout::Anaglyph;
    interface.setLook(look);
    const double before = turn.elapsed_ms();
    interface.setPointerOfPicture(mPointer.isOfPicture(mode));
    const bool laidOut = mStage.layOut(interfacePlaces(mode), dt, mPictures.fresh(), busy, drawPanels);
    const double layout = turn.elapsed_ms() - before;
    const PicturePlace place = mStage.placeOf(mode);
    const bool marked = mMarks.draw(mSession, mode);
    const bool same = setting == mDrawn && place == mPlace && !mPictures.fresh() && !laidOut && !marked;
    if (!mWindow.redrawNeeded() && same && !ViewDisplay::alternates(setting)) {
        mTimes.add(layout, 0, turn.elapsed_ms(), false);
        return false;
    }
    mPictures.takeFresh();
    mDrawn = setting;
    mPlace = place;
    show(setting);
    if (mTimes.on()) glFinish();
    const double all = turn.elapsed_ms();
    mPictures.drew(all / 1000);
    mTimes.add(layout, all - layout - before, all, true);
    return true;
}

void WindowDrawing::show(const ComposeSetting& setting) {
    const SizeOption size = mDisplay.windowSize();
    const glm::ivec2 origin = mWindow.framebufferOrigin();
    const PartInset inset{mPlace.corner.x, mPlace.corner.y, mPlace.part.x - mPlace.corner.x - mPlace.size.x,
                          mPlace.part.y - mPlace.corner.y - mPlace.size.y};
    mDisplay.draw(setting, [&](const ComposeSetting& one) {
        glDisable(GL_SCISSOR_TEST);
        glViewport(0, 0, size.width, size.height);
        // Pictures and panels cover both parts; the rest of the window is cleared to black.
        if (!mPictures.eyes().hasPicture() || !partsCover(one.mode, size)) {
            glClearColor(0, 0, 0, 1);
            glClear(GL_COLOR_BUFFER_BIT);
        }
        mPictures.eyes().draw(one, {0, 0, size.width, size.height}, origin.x, origin.y, inset);
        mStage.overPicture().render(InterfaceOpening{mPlace.corner, mPlace.size});
    });
}

}  // namespace stereonav
