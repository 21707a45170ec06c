#include "app/view/loading.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/command/quality.h"
#include "app/scene/shown_volume.h"
#include "app/view/sweep.h"
#include "engine/scene/slices.h"

namespace stereonav {
namespace {

// How its frames are made, and how it begins.
OpenScene opened(std::shared_ptr<Scene> shown, const ViewOptions& options, bool measure, Progress& progress) {
    OpenScene open;
    const Scene& scene = *shown;
    if (const auto* const light = scene.offered<TurningLight>()) open.sun = light->place();
    if (const auto* const models = scene.offered<LightModels>()) open.model = models->now();
    open.scene = std::move(shown);
    open.way.method = methodNamed(options.method, scene);
    // A study is opened quickly: it gets its default.
    if (const auto plan = qualityOf(options.scene, scene, options.method, progress)) {
        open.way = {nameOf(plan->setting.method), plan->setting};
    } else if (measure && options.method == "auto" && !scene.offered<SurfaceChoices>()) {
        progress.report(1.0, "measuring how to make the right eye");
        if (const auto measured = planScene(scene)) open.way.method = nameOf(measured->method);
    }
    open.way.edges = edgesOf(options.scene, scene);
    return open;
}

}  // namespace

OpenScene openScene(const ViewOptions& options, bool measure, const SizeOption& window, ViewSweep* sweep,
                    Progress& progress) {
    std::shared_ptr<Scene> scene = loadScene(options.scene, options.size, progress, kNoPicture);
    checkSize(window, options.scene, kViewBytes);
    // A recorded flight is looked at once, with the scene that it was given for.
    if (measure && !options.path.empty()) scene->check(readPath(options.path), options.path);
    if (sweep) sweep->use(*scene);
    return opened(std::move(scene), options, measure, progress);
}

OpenScene changedScene(const OpenScene& now, const SurfaceChange& change, const ViewOptions& options,
                       Progress& progress) {
    std::shared_ptr<Scene> scene = now.scene->offered<SurfaceChoices>()->changed(change, progress);
    OpenScene open = opened(std::move(scene), options, false, progress);
    open.sun = now.sun;  // frames are made meanwhile, which may turn it
    open.changed = true;
    return open;
}

void applyChange(const SceneChange& change, const SceneOptions& first, SceneOptions& options) {
    applyChange(change.surface, first, options);
    if (!change.seeds) return;
    options.volume.seeds = *change.seeds;
}

void SliceReading::cancel() {
    if (mProgress) mProgress->cancel();
}

void SliceReading::abandon() {
    mAbandoned = true;
    cancel();
}

void SliceReading::start(std::shared_ptr<const OpenScene> scene, std::function<void()> wake) {
    const auto* const source = scene->scene->offered<SliceSource>();
    if (busy() || !source) return;
    mFraction = 0;
    mAbandoned = false;
    mProgress = std::make_unique<Progress>(
        [this](double fraction, const std::string&) { mFraction = std::clamp(fraction, 0.0, 1.0); });
    mReading =
        std::async(std::launch::async, [this, source, scene = std::move(scene), wake = std::move(wake)] {
            try {
                auto study = source->readSlices(*mProgress);
                wake();
                return study;
            } catch (...) {
                wake();
                throw;
            }
        });
}

std::shared_ptr<const SliceStudy> SliceReading::take() {
    if (!busy() || mReading.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return nullptr;
    if (!mAbandoned) return mReading.get();
    try {
        mReading.get();
    } catch (const std::exception&) {
        // Nobody waits for it.
    }
    return nullptr;
}

}  // namespace stereonav
