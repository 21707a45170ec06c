// The quality dial: from --quality, --target-psnr and --target-ms to which warped pixels are cast as well.
#pragma once

#include "app/commands.h"
#include "app/scene_loading.h"
#include "engine/base/progress.h"

namespace stereonav {

// What can be checked without the scene. Throws Error.
void checkQuality(const SceneOptions& options, const std::string& method);

// Nothing where none of the options is given. Else measures the scene: what error is to be expected, on
// frames of its own flight cast in full, and what pixels cost where a time is the target. Throws Error,
// Cancelled.
Refinement refinementOf(const SceneOptions& options, const LoadedScene& scene, RightEyeMethod method,
                        Progress& progress);

}  // namespace stereonav
