#include "terrain/scene/ground_texture.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"

namespace stereonav {

ColorTexture groundTexture(const Heightfield& ground, const GroundTextureSize& size,
                           const GroundColorAt& colorAt, Progress& progress) {
    const glm::dvec2 origin(-0.5);
    const glm::dvec2 perTexel =
        glm::dvec2(ground.width(), ground.height()) / glm::dvec2(size.width, size.height);
    Plane<PackedColor> texels(size.width, size.height);
    constexpr int kBand = 64;
    constexpr const char* kColouring = "colouring the ground";
    for (int first = 0; first < size.height; first += kBand) {
        progress.report(double(first) / size.height, kColouring);
        parallelFor(std::min(kBand, size.height - first), [&](int k) {
            const int row = first + k;
            for (int i = 0; i < size.width; ++i) {
                const glm::dvec2 grid = origin + glm::dvec2(i + 0.5, size.height - row - 0.5) * perTexel;
                texels.at(i, row) = packColor(colorAt(i, row, grid));
            }
        });
    }
    ColorTexture texture(texels, origin, perTexel);
    progress.report(1, kColouring);
    return texture;
}

GroundTextureSize groundTextureSize(const Heightfield& ground, glm::dvec2 density) {
    constexpr int kMostSide = 32768;
    const double texels = ground.width() * density.x * ground.height() * density.y;
    if (texels > kMostGroundTexels) density *= std::sqrt(kMostGroundTexels / texels);
    const auto side = [](double n) { return static_cast<int>(std::clamp(n + 0.5, 1.0, double(kMostSide))); };
    return {side(ground.width() * density.x), side(ground.height() * density.y)};
}

}  // namespace stereonav
