#include "app/view/loading.h"

#include <exception>
#include <utility>

#include "app/scene/quality.h"
#include "app/scene/volume/shown_volume.h"
#include "app/view/sweep.h"
#include "engine/scene/slices.h"

namespace stereonav {
namespace {

// Returns a scene with the way of making frames and its initial state.
OpenScene opened(std::shared_ptr<Scene> shown, const ViewOptions& options, bool measure, Progress& progress) {
    progress.report(0, "opening");
    OpenScene open;
    const Scene& scene = *shown;
    if (const auto* const light = scene.offered<TurningLight>()) open.sun = light->place();
    if (const auto* const models = scene.offered<LightModels>()) open.model = models->now();
    open.scene = std::move(shown);
    open.way.method = methodNamed(options.method, scene);
    // Opening a study has to be fast: it gets its default.
    if (const auto plan = qualityOf(options.scene, scene, options.method, progress)) {
        open.way = {nameOf(plan->setting.method), plan->setting};
    } else if (measure && options.method == "auto" && !scene.offered<SurfaceChoices>()) {
        progress.report(0, "measuring the methods of making the right eye");
        if (const auto measured = planScene(scene)) open.way.method = nameOf(measured->method);
    }
    open.way.edges = edgesOf(options.scene, scene);
    progress.report(1, "opened");
    return open;
}

}  // namespace

OpenScene openScene(const ViewOptions& options, bool measure, const SizeOption& window, ViewSweep* sweep,
                    Progress& progress) {
    Progress reading(progress, 0, 0.9), opening(progress, 0.9, 1);
    std::shared_ptr<Scene> scene = loadScene(options.scene, options.size, reading, kNoPicture);
    checkSize(window, options.scene, kViewBytes);
    // A flight from a file is checked once, in the scene that it was given for.
    if (measure && !options.path.empty()) scene->check(readPath(options.path), options.path);
    if (sweep) sweep->use(*scene);
    return opened(std::move(scene), options, measure, opening);
}

OpenScene changedScene(const OpenScene& now, const SurfaceChange& change, const ViewOptions& options,
                       Progress& progress) {
    Progress changing(progress, 0, 0.9), opening(progress, 0.9, 1);
    std::shared_ptr<Scene> scene = now.scene->offered<SurfaceChoices>()->changed(change, changing);
    OpenScene open = opened(std::move(scene), options, false, opening);
    open.sun = now.sun;  // frames are made meanwhile, which may turn it
    open.changed = true;
    return open;
}

void applyChange(const SceneChange& change, const SceneOptions& first, SceneOptions& options) {
    applyChange(change.surface, first, options);
    if (change.pieces) options.volume.choices = *change.pieces;
}

void SliceReading::abandon() {
    mAbandoned = true;
    cancel();
}

void SliceReading::start(std::shared_ptr<const OpenScene> scene, std::function<void()> wake) {
    const auto* const source = scene->scene->offered<SliceSource>();
    if (busy() || !source) return;
    mAbandoned = false;
    mReading.start(
        [source, scene = std::move(scene)](Progress& progress) { return source->readSlices(progress); },
        std::move(wake));
}

std::shared_ptr<const SliceStudy> SliceReading::take() {
    try {
        return mReading.take().value_or(nullptr);
    } catch (const std::exception&) {
        if (!mAbandoned) throw;
    }
    return nullptr;
}

}  // namespace stereonav
