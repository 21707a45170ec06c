#include "terrain/scene/fine_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

namespace stereonav {

FineLight::FineLight(std::shared_ptr<const GroundLevels> levels, LightTiles tiles, SimdTarget target)
    : mLevels(std::move(levels)), mTiles(std::move(tiles)), mTarget(target) {}

std::optional<int> FineLight::levelFor(double spacing) const {
    const int level = static_cast<int>(std::lround(std::log2(spacing / mLevels->spacing(0).x)));
    if (level > shape().coarsest) return std::nullopt;
    return std::max(level, shape().finest);
}

std::optional<FineLight::LitTile> FineLight::lit(const LightTiles::Tile& tile, const SunAndSky& now) const {
    std::optional<TerrainLight> light = mTiles.read(tile);
    if (!light) return std::nullopt;
    const glm::ivec2 size(light->grid.width, light->grid.height),
        low = glm::max(tile.low() - 1, glm::ivec2(0)),
        end = glm::min(tile.low() + size + 1, mTiles.size(tile.level));
    std::optional<Heightfield> ground = mLevels->part(tile.level, low, end - low);
    if (!ground) return std::nullopt;
    LitTile lit{std::move(*ground), tile.low() - low, {}};
    light->grid.first = lit.first;
    TerrainRelight(lit.ground, std::move(*light), mTarget).relight(now, lit.brightness);
    return lit;
}

}  // namespace stereonav
