// `stereonav bake` of a terrain.
#pragma once

#include "app/options/bake_options.h"

namespace stereonav {

// Into the cache, where `--light auto` looks for the light of the same ground, or into options.out. What is
// done is kept when it is stopped, and the next run goes on from there. Throws Error, Cancelled.
int bakeTerrain(const BakeOptions& options);

}  // namespace stereonav
