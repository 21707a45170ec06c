#include "terrain/cast/caster_scene.h"

#include <algorithm>
#include <cmath>

#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"

namespace stereonav {
namespace {

double exactHit(const void* context, const double* origin, const double* direction, double fall, double tMin,
                int* cell, double* position) {
    const auto& ground = *static_cast<const Heightfield*>(context);
    const glm::dvec2 spacing = ground.spacing();
    const glm::dvec3 world(ground.worldFromGrid({origin[0], origin[1]}), origin[2]);
    const GroundHit hit =
        castPlain(ground, world, {direction[0] * spacing.x, direction[1] * spacing.y, direction[2]}, tMin,
                  {glm::dvec2(world), fall});
    cell[0] = hit.i, cell[1] = hit.j;
    position[0] = hit.u, position[1] = hit.v;
    return hit.t;
}

}  // namespace

GroundData groundData(const Heightfield& ground, const HeightPyramid& pyramid) {
    GroundData g;
    g.heights = ground.data();
    g.width = ground.width();
    g.height = ground.height();
    g.maxima = pyramid.data();
    std::copy(pyramid.offsets().begin(), pyramid.offsets().end(), g.maximaOffset);
    std::copy(pyramid.pitches().begin(), pyramid.pitches().end(), g.maximaPitch);
    g.levels = pyramid.levelCount();
    g.minHeight = ground.minHeight();
    g.maxHeight = ground.maxHeight();
    g.maxSlope = static_cast<float>(ground.maxSlope() * (1 + 1e-6));
    g.spacingX = ground.spacing().x;
    g.spacingY = ground.spacing().y;
    g.exactHit = exactHit;
    g.context = &ground;
    return g;
}

TextureData textureData(const ColorTexture& color, const glm::dvec2& spacing, const GroundFilter& filter) {
    TextureData t = color.forKernels(glm::dvec2(0.0), glm::dvec2(1.0));  // places are grid coordinates
    if (!filter.mipLevels) t.levels = 1;
    const glm::dvec2 texel = color.gridPerTexel() * spacing;
    t.texelsPerMetre =
        static_cast<float>(std::exp2(std::clamp(filter.levelBias, -8.0, 8.0)) / std::sqrt(texel.x * texel.y));
    return t;
}

}  // namespace stereonav
