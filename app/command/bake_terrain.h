// `stereonav bake` of a terrain.
#pragma once

#include "app/options/bake_options.h"

namespace stereonav {

// Bakes into the cache, where `--light auto` finds the light of the same ground, or into options.out. When
// stopped it keeps the finished part, and the next run goes on from there. Throws Error, Cancelled.
int bakeTerrain(const BakeOptions& options);

}  // namespace stereonav
