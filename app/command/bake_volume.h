// `stereonav bake` of CT studies and the built-in colon.
#pragma once

#include "app/options/bake_options.h"

namespace stereonav {

// Returns 1 where the bake was stopped before its end; finished parts are kept. Throws Error.
int bakeVolume(const BakeOptions& options);

}  // namespace stereonav
