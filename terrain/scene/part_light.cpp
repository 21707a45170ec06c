#include "terrain/scene/part_light.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/image/packed_color.h"
#include "terrain/light/terrain_horizon.h"
#include "terrain/scene/ground_color.h"

namespace stereonav {

PartLight::PartLight(const Heightfield& whole, const LightGrid& grid, const GroundBrightness& brightness,
                     const TerrainLook& look, const TerrainRelight::Display& shown)
    : mGrid(grid),
      mLook(look),
      mShown(shown),
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

void PartLight::takeFiner(std::shared_ptr<const FineLight> fine, const SunAndSky& now) {
    mFine = std::move(fine);
    mNow = now;
}

glm::vec3 PartLight::quotientAt(const glm::dvec2& world) const {
    const glm::dvec2 grid = (world - mOrigin) / mSpacing;
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

// Returns a quotient, clamped to the samples, which are around all texels but at the ground's edge.
glm::vec3 PartLight::quotientAt(const FineQuotients& fine, const glm::dvec2& world) const {
    const glm::ivec2 last(fine.quotients.width() - 1, fine.quotients.height() - 1);
    const glm::dvec2 grid = glm::clamp(
        (world - mFine->levels().originWorld()) / mFine->levels().spacing(fine.level) - glm::dvec2(fine.low),
        glm::dvec2(0), glm::dvec2(last));
    const glm::ivec2 at(grid), next = glm::min(at + 1, last);
    const glm::vec2 share(grid - glm::dvec2(at));
    const glm::vec3 *const south = fine.quotients.row(at.y), *const north = fine.quotients.row(next.y);
    return glm::mix(glm::mix(south[at.x], south[next.x], share.x),
                    glm::mix(north[at.x], north[next.x], share.x), share.y);
}

// Returns the quotients of finer light over a part; empty where there is none, and the whole's light is used.
std::optional<PartLight::FineQuotients> PartLight::finerOver(const Heightfield& part,
                                                             const ColorTexture& colors) const {
    if (!mFine) return std::nullopt;
    const std::optional<int> level = mFine->levelFor(part.spacing().x);
    if (!level) return std::nullopt;
    const glm::dvec2 first = part.worldFromGrid(colors.gridOrigin() + 0.5 * colors.gridPerTexel()),
                     extent = glm::dvec2(colors.level(0).width() - 1, colors.level(0).height() - 1) *
                              colors.gridPerTexel() * part.spacing(),
                     origin = mFine->levels().originWorld(), spacing = mFine->levels().spacing(*level);
    const glm::ivec2 last = mFine->size(*level) - 1;
    const auto inside = [&](const glm::dvec2& grid) {
        return glm::ivec2(glm::clamp(grid, glm::dvec2(0), glm::dvec2(last)));
    };
    const glm::ivec2 low = inside(glm::floor((first - origin) / spacing)),
                     high = inside(glm::ceil((first + extent - origin) / spacing));
    FineQuotients fine{*level, low, Plane<glm::vec3>(high.x - low.x + 1, high.y - low.y + 1)};
    parallelFor(fine.quotients.height(), [&](int j) {
        for (int i = 0; i < fine.quotients.width(); ++i)
            fine.quotients.at(i, j) = quotientAt(origin + glm::dvec2(low + glm::ivec2(i, j)) * spacing);
    });
    const glm::ivec2 from = low / kLightTileSide, to = high / kLightTileSide;
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) takeTile({*level, {x, y}}, fine);
    return fine;
}

void PartLight::takeTile(const LightTiles::Tile& tile, FineQuotients& fine) const {
    const std::optional<FineLight::LitTile> lit = mFine->lit(tile, mNow);
    if (!lit) return;
    const GroundLight light(mLook);
    const glm::ivec2 at = tile.low() - fine.low, size(lit->brightness.width, lit->brightness.height),
                     low = glm::max(-at, glm::ivec2(0)),
                     end = glm::min(size, glm::ivec2(fine.quotients.width(), fine.quotients.height()) - at);
    parallelFor(std::max(0, end.y - low.y), [&](int row) {
        const int j = low.y + row;
        for (int i = low.x; i < end.x; ++i) {
            const glm::ivec2 sample = lit->first + glm::ivec2(i, j);
            const float plain = light.at(sampleNormal(lit->ground, sample.x, sample.y));
            glm::vec3& quotient = fine.quotients.at(at.x + i, at.y + j);
            for (int c = 0; c < 3; ++c)
                quotient[c] = lightQuotient(mShown.exposure * lit->brightness.row(c, j)[i], plain);
        }
    });
}

void PartLight::apply(const Heightfield& part, ColorTexture& colors) const {
    const GroundLight light(mLook);
    const glm::dvec2 origin = colors.gridOrigin(), perTexel = colors.gridPerTexel();
    const int width = colors.level(0).width();
    const std::optional<FineQuotients> fine = finerOver(part, colors);
    colors.refill([&](int y, PackedColor* row) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec2 world = part.worldFromGrid(origin + (glm::dvec2(x, y) + 0.5) * perTexel);
            const glm::vec3 baked = (fine ? quotientAt(*fine, world) : quotientAt(world)) *
                                    std::max(light.at(part.normalAt(world)), kDarkestPlainLight);
            row[x] = packColor(unpackColor(row[x]) * (1.0f + mShown.share * (baked - 1.0f)));
        }
    });
}

}  // namespace stereonav
