// The eyes that a frame was made with.
#pragma once

#include "app/view/worker.h"
#include "engine/camera/stereo_rig.h"

namespace stereonav {

// Of one eye that one twice.
inline StereoViews viewsOf(const FrameRequest& request) {
    if (request.twoEyes) return makeStereoViews(request.pose, request.lens, request.stereo);
    StereoViews views;
    views.left = views.right = makeEyeView(request.pose, request.lens);
    return views;
}

}  // namespace stereonav
