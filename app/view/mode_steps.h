// Which mode comes next for who steps through them.
#pragma once

#include "engine/image/stereo_compose.h"

namespace stereonav {

// by: 1 or -1, around the end; 0: `now`. Left out are modes that show the eyes one after the other, which
// only flicker without the glasses and the display for them, unless the window began with that one.
OutputMode steppedMode(OutputMode now, int by, OutputMode first);

// What a picture of the window is saved as: its mode, or side by side where that fits in no picture.
ComposeSetting pictureSetting(const ComposeSetting& shown);

}  // namespace stereonav
