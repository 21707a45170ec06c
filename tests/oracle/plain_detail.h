#pragma once

#include "terrain/cast/caster_types.h"

namespace stereonav {

// The plain statement of what kernels work out: by how much ground in cell (i, j), at u, v in it, is brighter
// than without detail, as a share. footprint: a pixel's longer side there, metres.
double detailAt(const DetailData& detail, int i, int j, double u, double v, double footprint);

}  // namespace stereonav
