// The views that a frame was made with.
#pragma once

#include "app/view/view_frame.h"
#include "engine/camera/stereo_rig.h"

namespace stereonav {

// Returns the views of a request; with one eye, that eye twice.
inline StereoViews viewsOf(const FrameRequest& request) {
    if (request.twoEyes) return makeStereoViews(request.pose, request.lens, request.stereo);
    StereoViews views;
    views.left = views.right = makeEyeView(request.pose, request.lens);
    return views;
}

}  // namespace stereonav
