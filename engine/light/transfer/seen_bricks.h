// The bricks of texels that a picture looks up, as requests for a background bake.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"
#include "engine/volume/illumination_volume.h"

namespace stereonav {

// Returns the numbers of the bricks (x + bricks.x (y + bricks.y z)) with the texels around the surface points
// seen through every `every`-th pixel, those seen by most pixels first, without repeats. Pixels that met
// nothing do not count. every >= 1.
std::vector<std::uint32_t> bricksSeen(const EyeView& view, const EyeImage& image,
                                      const IlluminationVolume& light, int every = 4);

}  // namespace stereonav
