// The shadow that a ground casts on itself under one place of the sun, at every sample in one pass.
//
// The shadow's upper surface is followed from line to line of the samples, away from the sun: at a sample it
// is the higher of ground and shadow one line nearer to the sun, between the two samples there, less what the
// sun's rays sink on the way. Beside horizons that are baked for all azimuths it is exact to a sample's
// spacing and takes milliseconds. Beyond the ground's edges there is nothing.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "terrain/ground/heightfield.h"
#include "terrain/light/terrain_light.h"

namespace stereonav {

class ShadowCaster {
public:
    // Takes the heights at the samples of the grid.
    ShadowCaster(const Heightfield& ground, const LightGrid& grid);

    // Returns how much of the sun is hidden at each sample of the grid, 255: all. toSun: unit. With the sun
    // at or below the horizontal nothing is said: 0.
    std::vector<std::uint8_t> hidden(const glm::dvec3& toSun) const;

    std::size_t byteCount() const { return mHeights.size() * sizeof(float); }

private:
    LightGrid mGrid;
    glm::dvec2 mSpacing;          // metres between the ground's samples
    std::vector<float> mHeights;  // metres; NaN in holes
};

}  // namespace stereonav
