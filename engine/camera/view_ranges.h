// Permitted ranges of settings of eyes, lenses and directions, for the command line and scene files.
#pragma once

#include "engine/text/number_range.h"

namespace stereonav {

constexpr NumberRange kFovRange = within(1, 170, "degrees");  // vertical
constexpr NumberRange kSeparationRange = within(0, 1e9, "metres");
constexpr NumberRange kZeroParallaxRange = within(1e-9, 1e9, "metres");
constexpr NumberRange kPlaceRange = within(-1e9, 1e9, "metres");      // each coordinate
constexpr NumberRange kClearanceRange = within(1e-9, 1e9, "metres");  // from the ground
constexpr NumberRange kTurnRange = within(-360, 360, "degrees");      // headings, azimuths, rolls
constexpr NumberRange kUprightRange = within(-90, 90, "degrees");     // pitches, elevations

}  // namespace stereonav
