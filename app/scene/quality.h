// The quality dial: from --quality, --target-psnr and --target-ms to how the right eye is made and which of
// its warped pixels are cast as well.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "app/scene/scene_loading.h"
#include "app/scene/shown_as.h"
#include "engine/base/progress.h"
#include "engine/sampling/edge_rays.h"
#include "engine/stereo/quality_plan.h"

namespace stereonav {

// Nothing where none of the options is given. Else measures the scene, on frames of its own flight cast in
// full: what error is to be expected of each way of making the right eye and, where a time is the target,
// what it takes; then plans (engine/stereo/quality_plan.h). method: as named by the user, which is then kept,
// or "auto". Throws Error, Cancelled.
std::optional<QualityPlan> qualityOf(const SceneOptions& options, const Scene& scene,
                                     const std::string& method, Progress& progress);

// Rays at edges, as asked for, or as they are by default: kDefaultEdgeRays where rays are cast and the
// picture is not to have more of them everywhere, or light traced for each pixel.
EdgeSetting edgesOf(const SceneOptions& options, const Scene& scene, const RayOptions& rays = {});

// What a picture of so many rays takes, of what one of one ray does.
PixelBytes withRays(PixelBytes each, const RayOptions& rays);

// The frames that a scene is measured on: its start pose and some of its flight.
std::vector<StereoViews> calibrationViews(const Scene& scene);

}  // namespace stereonav
