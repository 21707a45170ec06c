// The viewer's part of coverage: the wall is looked at from what is shown, and what was not seen is flown to.
#include "app/view/frame_views.h"
#include "app/view/viewer.h"

namespace stereonav {

void Viewer::followCoverage() {
    if (mCoverage.poll()) mLayoutDue = true;
    mSession->setPaint(mCoverage.soFar().painter);
}

bool Viewer::actOnCoverage(ViewCommand command) {
    if (command == ViewCommand::ToggleCoverage)
        toggleCoverage();
    else if (command == ViewCommand::NextUnseen || command == ViewCommand::PreviousUnseen)
        flyToUnseen(command == ViewCommand::NextUnseen ? 1 : -1);
    else
        return false;
    return true;
}

// The left eye's picture: the right one shows little more.
void Viewer::showToCoverage() {
    if (!mCoverage.on() || mSession->slicesShown() || !mAsked.ofSession(*mPictures.frame())) return;
    const FrameRequest& of = mPictures.frame()->request;
    mCoverage.show(
        of.twoEyes ? makeStereoViews(of.pose, of.lens, of.stereo).left : makeEyeView(of.pose, of.lens),
        Window::now(), !of.flying);
}

// The picture that is shown counts too.
void Viewer::toggleCoverage() {
    if (!mSession) return;
    if (!mCoverage.can()) return mSession->notify("coverage is of an opaque colon's wall");
    mCoverage.switchOn(!mCoverage.on());
    mSession->notify(mCoverage.on() ? "coverage is on: F3 has it" : "coverage is off");
    if (mCoverage.on() && mPictures.frame()) showToCoverage();
}

void Viewer::flyToUnseen(int step) {
    if (!mSession || !mCoverage.can()) return;
    if (!mCoverage.on()) return mSession->notify("coverage is off: F9 begins it");
    const UnseenPart* const part = mCoverage.step(step);
    if (!part) return mSession->notify("nothing of that size was left unseen");
    mSession->flyTo(*part->view);
}

}  // namespace stereonav
