#include "app/view/window_closing.h"

#include <fmt/format.h>

#include "app/view/instruments.h"
#include "app/view/window_jobs.h"

namespace stereonav {

std::vector<std::string> WindowClosing::workAtHand() const {
    std::vector<std::string> work;
    if (mSession && mSession->paths().recording())
        work.push_back(fmt::format("a recording of {:.0f} s, which is kept", mSession->paths().recorded()));
    if (const std::string job = mJobs.atWork(); !job.empty()) work.push_back(job);
    const FindingList& findings = mInstruments.findingList();
    if (findings.writes()) work.push_back(findings.doing() + " of findings, which is lost");
    return work;
}

void WindowClosing::leave() {
    if (!mQuestion.wish(workAtHand(), Window::now())) return;
    mEnds = true;
    mWindow.close();
}

std::string WindowClosing::question() const {
    return mQuestion.text(workAtHand(), Window::now());
}

}  // namespace stereonav
