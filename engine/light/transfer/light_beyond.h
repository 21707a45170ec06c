// Light for places whose texels a bake did not light: inside a translucent volume of which only the surface
// was baked, at another isovalue, in a medium. Known light is averaged over blocks of 4^3 texels and spread
// over the whole grid, where blocks with few known texels are filled up from blocks twice as large (pull and
// push of Gortler et al. 1996, section 3.4.3). Near known texels it is their light, farther away a mean over
// ever more of it.
#pragma once

#include "engine/volume/illumination_volume.h"

namespace stereonav {

// Returns light on a grid of blocks, known everywhere (BakedLook::beyond); empty where no texel of `light` is
// known.
IlluminationVolume lightBeyond(const IlluminationVolume& light);

// Updates a result of lightBeyond() after texels of `light` have changed. Where no texel is known any more,
// `beyond` stays as it is.
void updateLightBeyond(const IlluminationVolume& light, IlluminationVolume& beyond);

}  // namespace stereonav
