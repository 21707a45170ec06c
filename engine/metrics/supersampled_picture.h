// A truth finer than any method: many rays a pixel, averaged in linear light.
#pragma once

#include "engine/base/progress.h"
#include "engine/frame/frame_maker.h"
#include "engine/render/eye_renderer.h"

namespace stereonav {

// Casts factor x factor rays in each pixel, 1 to 16, in strips of columns, so that it takes memory for one
// strip only: about 64 MB at most. progress is reported from 0 to 1. Throws Error, Cancelled.
Plane<PackedColor> renderSupersampled(const EyeRenderer& renderer, const EyeView& view, int factor,
                                      Progress& progress);
// Makes the same of one eye alone in a FrameMaker's exact way, at `time` seconds.
Plane<PackedColor> renderSupersampled(FrameMaker& frames, const EyeView& view, double time, int factor,
                                      Progress& progress);

}  // namespace stereonav
