// `view --bench` in the window: flies and rests as ViewBench says, has what was shown judged by the thread
// that makes frames, and ends the window when that is done.
#pragma once

#include <memory>

#include "app/view/asked_frames.h"
#include "app/view/view_bench.h"

namespace stereonav {

class CommandResult;

class BenchFlight {
public:
    // on: false measures nothing. whole: as ViewBench has it.
    BenchFlight(bool on, bool whole) : mBench(on ? std::make_shared<ViewBench>(whole) : nullptr) {}

    bool on() const { return mBench != nullptr; }
    // A frame came, and a picture was drawn.
    void cast(const ViewFrame& frame);
    void shown(const ShownPicture& picture, const FrameRequest& now);
    // Each turn. frame: the newest, null before it. True: all is judged, and the window may close. Throws
    // Error.
    bool step(ViewSession& session, ViewWorker& worker, const ViewFrame* frame, const AskedFrames& asked,
              bool refines);
    // What was measured, after the fields that say of what. mode, eye: of the window at its end.
    void end(CommandResult& result, OutputMode mode, const SizeOption& eye);

private:
    struct Judgement;
    std::shared_ptr<ViewBench> mBench;
    std::shared_ptr<Judgement> mJudgement;
};

}  // namespace stereonav
