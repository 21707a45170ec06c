// Closes the window, but not unasked while something is at work that would be lost.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/view/closing_question.h"
#include "app/view/session.h"
#include "engine/display/window.h"

namespace stereonav {

class Instruments;
class WindowJobs;

class WindowClosing {
public:
    // All of them outlive this.
    WindowClosing(std::optional<ViewSession>& session, Window& window, const WindowJobs& jobs,
                  const Instruments& instruments)
        : mSession(session), mWindow(window), mJobs(jobs), mInstruments(instruments) {}

    // Closes it, unless there is something to ask first: then what is asked is the question.
    void leave();
    std::string question() const;  // "": nothing is asked
    void goOn() { mQuestion.goOn(); }
    // Whether the last turn was the last one. The window's own button asks as a key does; asked: called then.
    template <typename Asked>
    bool ends(const Asked& asked) {
        if (mWindow.shouldClose() && !mEnds) {
            mWindow.keepOpen();
            leave();
            asked();
        }
        return mEnds || (mSession && mSession->quit());
    }

private:
    // What would end with the window, and what becomes of it.
    std::vector<std::string> workAtHand() const;

    std::optional<ViewSession>& mSession;
    Window& mWindow;
    const WindowJobs& mJobs;
    const Instruments& mInstruments;
    ClosingQuestion mQuestion;
    bool mEnds = false;  // the window closes, whatever is at work
};

}  // namespace stereonav
