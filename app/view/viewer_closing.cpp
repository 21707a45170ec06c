// The viewer's part that closes the window: not unasked while something is at work that would be lost.
#include <fmt/format.h>

#include "app/view/viewer.h"

namespace stereonav {

std::vector<std::string> Viewer::workAtHand() const {
    std::vector<std::string> work;
    if (mSession && mSession->recording())
        work.push_back(fmt::format("a recording of {:.0f} s, which is kept", mSession->recorded()));
    if (const std::string job = mJobs.atWork(); !job.empty()) work.push_back(job);
    if (mFindings.writes()) work.push_back(mFindings.doing() + " of findings, which is lost");
    return work;
}

void Viewer::leave() {
    if (mClosing.wish(workAtHand(), Window::now())) {
        mEnds = true;
        mWindow.close();
    }
    mLayoutDue = true;
}

// By the window's own button it asks as by a key.
bool Viewer::ends() {
    if (mWindow.shouldClose() && !mEnds) {
        mWindow.keepOpen();
        leave();
    }
    return mEnds || (mSession && mSession->quit());
}

void Viewer::endSession() {
    if (mSession) mNotices.tell(mSession->keepWork());
}

std::string Viewer::closingQuestion() const {
    return mClosing.text(workAtHand(), Window::now());
}

void Viewer::answerClosing(bool close) {
    if (!close) return mClosing.goOn();
    leave();
}

}  // namespace stereonav
