// A combination drawn by the program's own functions, as `render` does, but that both eyes are kept.
#pragma once

#include <memory>
#include <string>

#include "app/command/render_command.h"
#include "app/scene/narrowed_eyes.h"
#include "app/scene/scene_loading.h"
#include "engine/image/eye_image.h"
#include "engine/sampling/edge_rays.h"

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

    // Draws both eyes at the scene's start pose, as the options say.
    Eyes eyes();
    // Returns what rays are added to pixels at edges, of both eyes of eyes().
    const EdgeSetting& edges() const { return mEdges; }
    // Each pixel of the right eye cast, by one ray; of a medium each eye swept with samples of its own, by
    // the slices that the method has: one sweep for both eyes leans between them.
    Eyes inFull();
    // The same as inFull(), with the rays at edges.
    Eyes inFullAndSmooth();
    // The same as inFullAndSmooth(), computed plainly from inFull(): the whole picture is cast through each
    // place of a pixel that has a ray, and the mean is taken at the edges.
    Eyes smoothedPlainly(const Eyes& full);

    // Returns whether the method for a medium has one sweep for both eyes.
    bool sweepsTogether() const;

    // Returns how many pixels of what sweeps gave, before it was packed, have a channel that is no number, or
    // infinite.
    long long notFinite() const { return mNotFinite; }

    const Scene& scene() const { return *mScene; }
    StereoViews views() const {
        return makeStereoViews(mScene->startPose, mScene->lens,
                               NarrowedEyes(*mScene).at(mScene->startPose, 0));
    }

private:
    // method: a name, "" for what the options say. Light that is worked out for what is seen is there.
    Eyes frame(const std::string& method, const EdgeSetting& edges);

    RenderOptions mOptions;
    EdgeSetting mEdges;
    long long mNotFinite = 0;
    std::unique_ptr<Scene> mScene;
};

}  // namespace stereonav::test
