// Makes a frame as it was asked for: eyes that fit the picture where that is wanted, paint, the truth in the
// place of the right eye, and planes for the late warp.
#pragma once

#include "app/view/view_frame.h"

namespace stereonav {

// For the thread that makes frames; the light, the paint and the model of the scene become those of the
// request. Throws the scene's exceptions.
void makeFrame(const Scene& scene, const FrameRequest& request, TruthMaker& truth, ViewFrame& frame);

}  // namespace stereonav
