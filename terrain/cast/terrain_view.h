// Turns a view so that the casting kernels can go from lower to higher rays, and cuts it into bands that
// follow the direction in which rays rise.
#pragma once

#include "engine/camera/eye_view.h"
#include "terrain/cast/caster_types.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// Returns a view over this ground in the kernels' form, without the air of a physical sky.
CasterView makeCasterView(const EyeView& view, const Heightfield& ground);

// Returns the number of bands that together cover the picture, 1 or more.
int bandCount(const CasterView& view);
// Returns a band; index: 0 to bandCount() - 1.
CasterBand bandOf(const CasterView& view, int index);

}  // namespace stereonav
