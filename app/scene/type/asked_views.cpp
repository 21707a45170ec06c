#include "app/scene/type/asked_views.h"

#include "engine/math/constants.h"

namespace stereonav {

void adjustViews(const SceneOptions& options, Scene& scene) {
    if (options.separation_m) scene.stereo.separation = *options.separation_m;
    if (options.zeroParallax_m) scene.stereo.zeroParallax = *options.zeroParallax_m;
    if (options.fov_deg) scene.lens.verticalFov = *options.fov_deg * kRadians;
}

}  // namespace stereonav
