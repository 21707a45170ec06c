// The viewer's part that measures a flight: `view --bench`.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "app/view/viewer.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {

// On the thread that makes frames, when the flight is over.
struct Viewer::BenchJudgement {
    Progress progress;
    std::atomic<bool> done = false;
    Facts times;  // without what is judged, where the window is closed meanwhile
};

void Viewer::stepBench() {
    if (!mBench || !mSession) return;
    if (mJudgement) {
        if (mJudgement->done) mWindow.close();
        return;
    }
    const RecordedPath& path = mSession->path();
    const bool animated =
        mSession->open().scene->offered<Animation>() != nullptr && !mSettings.options().refine;
    const bool rests = animated || !mSession->moving();
    const bool ready =
        mFrame && rests && !mWorker->loading().busy && (animated || mFrame->request.version == mAsked);
    if (ready && path.samples().size() < 2)
        throw Error("--bench", "", "this scene has no flight of its own", "give --path FILE");
    const double duration = path.samples().size() < 2 ? 0 : path.duration();
    switch (mBench->step(Window::now(), ready, mSession->playing(), duration)) {
        case ViewBench::Wish::Fly:
        case ViewBench::Wish::Stop:
            mSession->act({ViewCommand::Play});
            break;
        case ViewBench::Wish::Judge:
            mJudgement = std::make_shared<BenchJudgement>();
            mJudgement->times = mBench->facts();
            mWorker->ask([bench = mBench, judgement = mJudgement](const OpenScene& open) {
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
}

// What is there now came to the screen.
void Viewer::noteShown() {
    if (mBench && !mJudgement && mPicture.left) mBench->shown(mPicture, mPresent, Window::now());
}

void Viewer::endBench() {
    if (!mBench) return;
    const bool judged = !mJudgement || mJudgement->done;
    if (!judged) mJudgement->progress.cancel();
    const SizeOption eye = pictureSize();
    mNotices.result().add("size", FactIntegers{eye.width, eye.height});
    mNotices.result().add("mode", std::string(infoOf(shownMode()).shortName));
    mNotices.result().add("threads", static_cast<std::int64_t>(threadCount()));
    mNotices.result().add("simd", std::string(nameOf(availableTarget(SimdTarget::Auto))));
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    mNotices.result().add("renderer", std::string(renderer ? renderer : ""));
    for (Fact& fact : judged ? mBench->facts() : mJudgement->times) {
        if (const auto* number = std::get_if<double>(&fact.value); number && std::isfinite(*number))
            mNotices.result().say(fmt::format("{:17} {:8.2f}\n", fact.key, *number));
        mNotices.result().add(fact.key, std::move(fact.value));
    }
}

}  // namespace stereonav
