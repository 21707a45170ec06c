// `view --bench` in the window: flies and rests as ViewBench says, has the pictures judged by the thread that
// makes frames, and closes the window when that is done.
#pragma once

#include <memory>

#include "app/view/asked_frames.h"
#include "app/view/view_bench.h"

namespace stereonav {

class CommandResult;
class ViewWorker;

class BenchFlight {
public:
    // on: false measures nothing. whole: see ViewBench.
    BenchFlight(bool on, bool whole) : mBench(on ? std::make_shared<ViewBench>(whole) : nullptr) {}

    bool on() const { return mBench != nullptr; }
    // Notes a frame that came; shown() a picture that was drawn.
    void cast(const ViewFrame& frame);
    void shown(const ShownPicture& picture, const FrameRequest& now);
    // Takes a step; to be called each turn. frame: the newest, null before the first. Returns true when all
    // is judged and the window may close. Throws Error.
    bool step(ViewSession& session, ViewWorker& worker, const ViewFrame* frame, const AskedFrames& asked,
              bool refines);
    // Adds the results after the fields that describe the run. mode, eye: of the window at its end.
    void end(CommandResult& result, OutputMode mode, const SizeOption& eye);

private:
    struct Judgement;
    std::shared_ptr<ViewBench> mBench;
    std::shared_ptr<Judgement> mJudgement;
};

}  // namespace stereonav
