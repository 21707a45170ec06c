// A line over the surface: its places, its measurements, and its profile.
#pragma once

#include "app/view/clipboard.h"
#include "app/view/instruments.h"
#include "app/view/window_jobs.h"

namespace stereonav {

void drawMeasurePanel(Instruments& instruments, WindowJobs& jobs, ViewSession& session,
                      const Clipboard& clipboard);

}  // namespace stereonav
