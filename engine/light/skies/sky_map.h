// The sky by direction: any source (gradient, image, light probe) resampled once into an octahedral
// map, so that a lookup needs no trigonometry.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Octahedral map of the whole sphere: direction d maps to p = (d.x, d.y) / (|d.x| + |d.y| + |d.z|),
// and where d.z < 0 to (1 - |p.y|, 1 - |p.x|) with the signs of p. Texel centre (i, j) of an n x n
// map is p = ((i + 0.5) / n * 2 - 1, (j + 0.5) / n * 2 - 1).
class SkyMap {
public:
    SkyMap() = default;
    // radiance: linear RGB for a unit world direction; size: texels a side, 4 to 4096.
    SkyMap(int size, const std::function<glm::vec3(const glm::vec3&)>& radiance);

    const Plane<PackedColor>& map() const { return mMap; }
    static glm::vec3 directionOf(float px, float py);  // unit; p in [-1, 1]^2

private:
    Plane<PackedColor> mMap;
};

// Returns the built-in sky, linear RGB 0 to 1: horizon to zenith, and haze below the horizon.
glm::vec3 gradientSky(const glm::vec3& direction);

}  // namespace stereonav
