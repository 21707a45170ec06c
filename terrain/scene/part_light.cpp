#include "terrain/scene/part_light.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "engine/image/packed_color.h"
#include "terrain/light/terrain_horizon.h"
#include "terrain/scene/ground_color.h"

namespace stereonav {

PartLight::PartLight(const Heightfield& whole, const LightGrid& grid, const GroundBrightness& brightness,
                     const TerrainLook& look, const TerrainRelight::Display& shown)
    : mGrid(grid),
      mLook(look),
      mShare(shown.share),
      mOrigin(whole.originWorld()),
      mSpacing(whole.spacing()),
      mQuotients(3 * grid.count()) {
    const GroundLight light(look);
    parallelFor(grid.height, [&](int j) {
        for (int i = 0; i < grid.width; ++i) {
            const float plain = light.at(sampleNormal(whole, grid.column(i), grid.row(j)));
            const std::size_t k = static_cast<std::size_t>(j) * grid.width + i;
            for (int c = 0; c < 3; ++c)
                mQuotients[c * grid.count() + k] =
                    lightQuotient(shown.exposure * brightness.row(c, j)[i], plain);
        }
    });
}

glm::vec3 PartLight::quotientAt(const glm::dvec2& grid) const {
    const LightGrid::Place x = mGrid.placeX(grid.x), y = mGrid.placeY(grid.y);
    const std::size_t south = static_cast<std::size_t>(y.index) * mGrid.width + x.index;
    glm::vec3 mixed;
    for (int c = 0; c < 3; ++c) {
        const float* const a = mQuotients.data() + c * mGrid.count() + south;
        const float* const b = a + mGrid.width;
        mixed[c] = glm::mix(glm::mix(a[0], a[1], x.next), glm::mix(b[0], b[1], x.next), y.next);
    }
    return mixed;
}

void PartLight::apply(const Heightfield& part, ColorTexture& colors) const {
    const GroundLight light(mLook);
    const glm::dvec2 origin = colors.gridOrigin(), perTexel = colors.gridPerTexel();
    const int width = colors.level(0).width();
    colors.refill([&](int y, PackedColor* row) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec2 world = part.worldFromGrid(origin + (glm::dvec2(x, y) + 0.5) * perTexel);
            const glm::vec3 baked = quotientAt((world - mOrigin) / mSpacing) *
                                    std::max(light.at(part.normalAt(world)), kDarkestPlainLight);
            row[x] = packColor(unpackColor(row[x]) * (1.0f + mShare * (baked - 1.0f)));
        }
    });
}

}  // namespace stereonav
