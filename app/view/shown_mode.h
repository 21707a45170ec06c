// How eyes are shown: both in a mode, or one.
#pragma once

#include "engine/image/stereo_compose.h"

namespace stereonav {

struct ShownMode {
    OutputMode mode = OutputMode::SideBySide;  // where one eye is shown: the mode that key 3 goes to
    bool stereo = true;                        // false: one eye, in the middle of the head

    OutputMode shown() const { return stereo ? mode : OutputMode::Left; }
    bool operator==(const ShownMode&) const = default;
};

}  // namespace stereonav
