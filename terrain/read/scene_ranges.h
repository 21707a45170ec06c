// Ranges of what is said of terrains, on the command line and in scene files alike.
#pragma once

#include "engine/text/number_range.h"

namespace stereonav {

constexpr NumberRange kVerticalScaleRange = within(1e-6, 1e6);  // factor on heights

}  // namespace stereonav
