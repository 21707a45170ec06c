// The sweep of docs/volume_light.md in GLSL: for each slab one pass to the eyes and one to the light (Kniss
// et al. 2003, sections 3 and 4). Needs a current OpenGL 4.5 context, the same for its whole life.
#pragma once

#include <memory>
#include <span>

#include "engine/medium/model/medium_picture.h"
#include "engine/medium/sweep/sweep_geometry.h"

namespace stereonav {

class MediumGpu {
public:
    // Uploads the medium. Throws Error where a texture would not fit.
    explicit MediumGpu(const Medium& medium);
    ~MediumGpu();

    // Makes the pictures of MediumSweep::render and reads them back. time: seconds. Waits until the GPU is
    // done. Throws Error for views that it does not support.
    void render(const MediumLook& look, const SweepSetting& setting, std::span<const EyeView> eyes,
                const glm::dvec3& head, double time, std::span<MediumPicture> pictures);

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
