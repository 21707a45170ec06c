// A whole picture by delta tracking.
#pragma once

#include "engine/medium/paths/delta_tracking.h"
#include "engine/medium/paths/delta_tracking_bounds.h"

namespace stereonav {

inline TrackedPicture trackPicture(const Medium& medium, const MediumLook& look, const EyeView& view,
                                   const TrackingSetting& setting, double time = 0) {
    return trackRows(medium, makeExtinctionBounds(medium, time), look, view, setting, time, {0, view.height});
}

}  // namespace stereonav
