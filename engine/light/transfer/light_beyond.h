// Light for places whose texels a bake did not light: inside a translucent volume whose surface alone was
// baked, at another isovalue, in a medium. What is known is averaged over blocks of 4^3 texels and, blocks
// that know little taking the rest from ones twice as large, spread over the whole grid (the pull and push of
// Gortler et al. 1996, section 3.4.3): near what is known its light, farther away that of ever more of it.
#pragma once

#include "engine/volume/illumination_volume.h"

namespace stereonav {

// Returns light on a grid of blocks, all known (BakedLook::beyond); empty where nothing of `light` is.
IlluminationVolume lightBeyond(const IlluminationVolume& light);

// Brings what lightBeyond() gave up to date, after texels of `light` have changed. Where nothing is known any
// more `beyond` stays as it is.
void updateLightBeyond(const IlluminationVolume& light, IlluminationVolume& beyond);

}  // namespace stereonav
