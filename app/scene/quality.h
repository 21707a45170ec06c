// The quality dial: from --quality, --target-psnr and --target-ms to the method of the right eye and the
// warped pixels that are cast in addition.
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

// Returns the plan (engine/stereo/quality_plan.h); empty where none of the options is given. Measures the
// scene on frames of its own flight, cast in full: the expected error of each method and, for a time as
// target, its cost. method: one that is kept, or "auto". Throws Error, Cancelled.
std::optional<QualityPlan> qualityOf(const SceneOptions& options, const Scene& scene,
                                     const std::string& method, Progress& progress);

// Returns the rays at edges that the options ask for, or the default: kDefaultEdgeRays where rays are cast,
// unless the picture gets more rays everywhere or its light is traced for each pixel.
EdgeSetting edgesOf(const SceneOptions& options, const Scene& scene, const RayOptions& rays = {});

// Returns the bytes of a picture with the rays that the options ask for, given those of a picture with one
// ray a pixel.
PixelBytes withRays(PixelBytes each, const RayOptions& rays);

// Returns the frames that a scene is measured on: its start pose and some frames of its flight.
std::vector<StereoViews> calibrationViews(const Scene& scene);

}  // namespace stereonav
