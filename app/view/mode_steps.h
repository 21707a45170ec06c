// The next mode when the user steps through the modes.
#pragma once

#include "engine/image/stereo_compose.h"

namespace stereonav {

// Returns the next mode. by: 1 or -1, cyclically; 0: `now`. Modes that show the eyes in turn are left out,
// since they only flicker without suitable glasses and display, unless the window began with that mode.
OutputMode steppedMode(OutputMode now, int by, OutputMode first);

// Returns the setting for a saved picture of the window: its mode, or side by side where that does not fit in
// a picture.
ComposeSetting pictureSetting(const ComposeSetting& shown);

}  // namespace stereonav
