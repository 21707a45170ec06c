// The flight that is played: recorded, cut, smoothed, kept, made into a movie.
#pragma once

#include "app/view/bookmarks.h"
#include "app/view/keyframe_edit.h"
#include "app/view/window_input.h"
#include "app/view/window_jobs.h"

namespace stereonav {

// places: null where none can be kept.
void drawPathPanel(ViewSession& session, KeyframeEdit& edit, const Bookmarks* places, WindowJobs& jobs,
                   AskedActions& actions);

}  // namespace stereonav
