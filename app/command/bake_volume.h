// `stereonav bake` of CT studies and the built-in colon.
#pragma once

#include "app/options/bake_options.h"

namespace stereonav {

// Throws Error. 1 where it was stopped before its end; what is done is kept.
int bakeVolume(const BakeOptions& options);

}  // namespace stereonav
