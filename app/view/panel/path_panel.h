// The flight that is played: recording, cutting, smoothing, saving, and making a movie of it.
#pragma once

#include "app/view/asked_actions.h"
#include "app/view/bookmarks.h"
#include "app/view/keyframe_edit.h"
#include "app/view/window_jobs.h"

namespace stereonav {

// places: null where none can be kept.
void drawPathPanel(ViewSession& session, KeyframeEdit& edit, const Bookmarks* places, WindowJobs& jobs,
                   AskedActions& actions);

}  // namespace stereonav
