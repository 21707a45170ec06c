// Everything a ray caster needs of a volume. Immutable once shown.
#pragma once

#include "engine/volume/surface_cells.h"
#include "engine/volume/volume.h"
#include "engine/volume/volume_look.h"

namespace stereonav {

struct VolumeScene {
    GreyVolume field;    // the surface lies where its trilinear value reaches cells.isovalue
    SurfaceCells cells;  // cells of `field`
    VolumeLook look;
};

}  // namespace stereonav
