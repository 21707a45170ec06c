// Closes the window, after a question while work would be lost.
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
    // The arguments must outlive this object.
    WindowClosing(std::optional<ViewSession>& session, Window& window, const WindowJobs& jobs,
                  const Instruments& instruments)
        : mSession(session), mWindow(window), mJobs(jobs), mInstruments(instruments) {}

    // Closes the window unless there is something to ask first: then the question is shown.
    void leave();
    std::string question() const;  // "": nothing is asked
    bool asks() const { return !question().empty(); }
    void goOn() { mQuestion.goOn(); }
    // Returns whether the last turn was the final one. The window's own button asks like a key; asked: called
    // then.
    template <typename Asked>
    bool ends(const Asked& asked) {
        if (mWindow.shouldClose() && !mEnds) {
            mWindow.keepOpen();
            leave();
            asked();
        }
        return mEnds;
    }

private:
    // Returns the work that would end with the window, with the consequences.
    std::vector<std::string> workAtHand() const;

    std::optional<ViewSession>& mSession;
    Window& mWindow;
    const WindowJobs& mJobs;
    const Instruments& mInstruments;
    ClosingQuestion mQuestion;
    bool mEnds = false;  // the window closes in spite of work
};

}  // namespace stereonav
