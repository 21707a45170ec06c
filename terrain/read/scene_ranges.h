// Permitted ranges of settings of terrains, for the command line and scene files.
#pragma once

#include "engine/text/number_range.h"

namespace stereonav {

constexpr NumberRange kVerticalScaleRange = within(1e-6, 1e6);  // factor on heights

}  // namespace stereonav
