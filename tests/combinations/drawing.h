// A combination drawn by the program's own functions, as `render` does, but that both eyes are kept.
#pragma once

#include <memory>
#include <string>

#include "app/command/commands.h"
#include "app/command/narrowed_eyes.h"
#include "app/scene/scene_loading.h"
#include "engine/image/eye_image.h"

namespace stereonav::test {

struct Eyes {
    EyeImage left, right;
};

class Drawing {
public:
    // Loads with kernels of this instruction set. Throws Error for what render refuses.
    Drawing(const RenderOptions& options, SimdTarget set);
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    // At the scene's start pose; method: a name, "" for the one that the options say. Light that is worked
    // out for what is seen is there.
    Eyes eyes(const std::string& method = "");
    // Each pixel of the right eye cast; of a medium each eye swept with samples of its own, by the slices
    // that the method has: one sweep for both eyes leans between them.
    Eyes inFull();

    // Of a medium: whether the method has one sweep for both eyes.
    bool sweepsTogether() const;

    // What sweeps gave before it was packed: pixels of which a channel is no number, or infinite.
    long long notFinite() const { return mNotFinite; }

    const Scene& scene() const { return *mScene; }
    StereoViews views() const {
        return makeStereoViews(mScene->startPose, mScene->lens,
                               NarrowedEyes(*mScene).at(mScene->startPose, 0));
    }

private:
    RenderOptions mOptions;
    long long mNotFinite = 0;
    std::unique_ptr<Scene> mScene;
};

}  // namespace stereonav::test
