#include "app/view/bench_flight.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "app/output/command_result.h"
#include "app/view/worker.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/display/window.h"
#include "engine/scene/capabilities.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

// Results that the thread that makes frames computes when the flight is over.
struct BenchFlight::Judgement {
    Progress progress;
    std::atomic<bool> done = false;
    Facts times;  // only times, without errors, for a window that is closed before the judgement
};

void BenchFlight::cast(const ViewFrame& frame) {
    if (mBench) mBench->cast(frame);
}

bool BenchFlight::step(ViewSession& session, ViewWorker& worker, const ViewFrame* frame,
                       const AskedFrames& asked, bool refines) {
    if (!mBench) return false;
    if (mJudgement) return mJudgement->done;
    const RecordedPath& path = session.paths().path();
    const bool animated = session.open().scene->offered<Animation>() != nullptr && !refines;
    const bool rests = animated || !session.moving();
    const bool ready =
        frame && rests && !worker.scenes().loading().busy && (animated || asked.isNewest(*frame));
    if (ready && path.samples().size() < 2)
        throw Error("--bench", "", "this scene has no flight of its own", "give one with --path FILE");
    const double duration = path.samples().size() < 2 ? 0 : path.duration();
    switch (mBench->step(Window::now(), ready, session.paths().playing(), duration)) {
        case ViewBench::Wish::Fly:
        case ViewBench::Wish::Stop:
            session.act({ViewCommand::Play});
            break;
        case ViewBench::Wish::Judge:
            mJudgement = std::make_shared<Judgement>();
            mJudgement->times = mBench->facts();
            worker.ask([bench = mBench, judgement = mJudgement](const OpenScene& open) {
                try {
                    bench->judge(*open.scene, judgement->progress);
                } catch (...) {
                    judgement->done = true;
                    throw;
                }
                judgement->done = true;
            });
            break;
        case ViewBench::Wish::None:
            break;
    }
    return false;
}

void BenchFlight::shown(const ShownPicture& picture, const FrameRequest& now) {
    if (mBench && !mJudgement && picture.left) mBench->shown(picture, now, Window::now());
}

void BenchFlight::end(CommandResult& result, OutputMode mode, const SizeOption& eye) {
    if (!mBench) return;
    const bool judged = !mJudgement || mJudgement->done;
    if (!judged) mJudgement->progress.cancel();
    result.add("size", FactIntegers{eye.width, eye.height});
    result.add("mode", std::string(infoOf(mode).shortName));
    result.add("threads", static_cast<std::int64_t>(threadCount()));
    result.add("simd", std::string(nameOf(availableTarget(SimdTarget::Auto))));
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    result.add("renderer", std::string(renderer ? renderer : ""));
    for (Fact& fact : judged ? mBench->facts() : mJudgement->times) {
        if (const auto* number = std::get_if<double>(&fact.value); number && std::isfinite(*number))
            result.say(fmt::format("{:17} {:8.2f}\n", fact.key, *number));
        result.add(fact.key, std::move(fact.value));
    }
}

}  // namespace stereonav
