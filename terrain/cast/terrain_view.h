// Turns a view so that the casting kernels can go from lower to higher rays, and cuts it into bands that
// follow the direction in which rays rise.
#pragma once

#include "engine/camera/eye_view.h"
#include "terrain/cast/caster_types.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

CasterView makeCasterView(const EyeView& view, const Heightfield& ground);

int bandCount(const CasterView& view);
CasterBand bandOf(const CasterView& view, int index);

}  // namespace stereonav
