// Baked light at work: brightness of every baked sample under the present sun and sky, and from it the
// ground's lit colours. One pass each, when the sun moves; pictures are then cast as ever, at no cost of
// their own: the light does not depend on the eye, and is filtered with the colour.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/image/color_texture.h"
#include "engine/simd/simd_target.h"
#include "terrain/ground/heightfield.h"
#include "terrain/light/relight_kernel_types.h"
#include "terrain/light/sun_and_sky.h"
#include "terrain/light/terrain_light.h"

namespace stereonav {

// Irradiance / pi, linear, by baked sample: three planes, red, green, blue.
struct GroundBrightness {
    int width = 0, height = 0;
    std::vector<float> planes;
    // The share of the sun's disc above the baked horizon, 0..1, by sample. Empty: not asked for, or not
    // baked.
    std::vector<float> sunShown;

    std::size_t planeSize() const { return static_cast<std::size_t>(width) * height; }
    const float* row(int channel, int j) const {
        return planes.data() + channel * planeSize() + static_cast<std::size_t>(j) * width;
    }
    glm::vec3 at(int i, int j) const { return {row(0, j)[i], row(1, j)[i], row(2, j)[i]}; }
};

class TerrainRelight {
public:
    TerrainRelight(const Heightfield& ground, TerrainLight light, SimdTarget target = SimdTarget::Auto);

    // Sets the brightness under this light. Samples in holes get the mean of those known beside them, or
    // none. withSunShown: GroundBrightness::sunShown is wanted too.
    // hidden: that of a ShadowCaster for that sun, in the place of baked horizons; null: none.
    void relight(const SunAndSky& now, GroundBrightness& brightness, bool withSunShown = false,
                 const std::vector<std::uint8_t>* hidden = nullptr) const;
    // Takes openness at the same samples in place of the light's own.
    void takeOpenness(std::vector<std::uint8_t> openness) { mLight.openness = std::move(openness); }
    // Returns sunShown between the baked samples, at a grid coordinate of the ground; 1 where it was not
    // asked for or baked.
    float sunShownAt(const GroundBrightness& brightness, const glm::dvec2& grid) const;

    // How light is shown.
    struct Display {
        float exposure = 1;  // factor on the light: exposureOf()
        float share = 1;     // share of the light's variation that shows: 0 leaves colours as they are
    };
    // Lights colours. lit: of the same size and place as albedo; its texels become those of albedo times the
    // light, 1 + share * (exposure * brightness - 1).
    void lightTexture(const ColorTexture& albedo, const GroundBrightness& brightness, const Display& display,
                      ColorTexture& lit) const;

    const TerrainLight& light() const { return mLight; }

private:
    void closeHoles(GroundBrightness& brightness) const;

    TerrainLight mLight;
    const RelightKernels* mKernels;
    std::vector<float> mNormals;        // unit: planes x, y, z of the baked samples
    std::vector<std::uint32_t> mHoles;  // indices of samples in holes
};

}  // namespace stereonav
