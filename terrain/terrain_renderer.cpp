// Plain first version: the cell walk for every ray.
#include "terrain/terrain_renderer.h"

#include <algorithm>
#include <cmath>

#include "terrain/plain_caster.h"

namespace stereonav {

struct TerrainRenderer::State {};

namespace {

PackedColor skyColor(const SkyMap& sky, const glm::dvec3& d) {
    const double s = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    double px = d.x / s, py = d.y / s;
    if (d.z < 0) {
        const double qx = std::copysign(1 - std::abs(py), px), qy = std::copysign(1 - std::abs(px), py);
        px = qx, py = qy;
    }
    const int n = sky.map().width();
    const auto index = [n](double p) { return std::clamp(static_cast<int>((p * 0.5 + 0.5) * n), 0, n - 1); };
    return sky.map().at(index(px), index(py));
}

PackedColor groundColor(const ColorTexture& color, double gx, double gy) {
    const auto& level = color.level(0);
    const double x = (gx - color.gridOrigin().x) / color.gridPerTexel().x - 0.5;
    const double y = (gy - color.gridOrigin().y) / color.gridPerTexel().y - 0.5;
    const int i = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(0, level.width() - 2));
    const int j = std::clamp(static_cast<int>(std::floor(y)), 0, std::max(0, level.height() - 2));
    const int i1 = std::min(i + 1, level.width() - 1), j1 = std::min(j + 1, level.height() - 1);
    const float u = static_cast<float>(std::clamp(x - i, 0.0, 1.0)),
                v = static_cast<float>(std::clamp(y - j, 0.0, 1.0));
    const glm::vec3 south = unpackColor(level.at(i, j)) * (1 - u) + unpackColor(level.at(i1, j)) * u;
    const glm::vec3 north = unpackColor(level.at(i, j1)) * (1 - u) + unpackColor(level.at(i1, j1)) * u;
    return packColor(south * (1 - v) + north * v);
}

void castPixel(const TerrainScene& scene, const EyeView& view, int x, int y, EyeImage& image) {
    const glm::dvec3 d = view.rayDirection(x + 0.5, y + 0.5);
    const GroundHit hit = castPlain(scene.ground, view.eye, d, view.nearDepth);
    const bool miss = !std::isfinite(hit.t);
    image.viewDepth.at(x, y) = static_cast<float>(hit.t);
    image.color.at(x, y) =
        miss ? skyColor(scene.sky, d) : groundColor(scene.color, hit.i + hit.u, hit.j + hit.v);
}

}  // namespace

TerrainRenderer::TerrainRenderer(const TerrainScene& scene, SimdTarget) : mScene(scene) {}
TerrainRenderer::~TerrainRenderer() = default;
int TerrainRenderer::tileCount(const EyeView& view) const {
    return view.height;
}
void TerrainRenderer::renderTile(const EyeView& view, int tile, EyeImage& image) const {
    for (int x = 0; x < view.width; ++x) castPixel(mScene, view, x, tile, image);
}
void TerrainRenderer::renderPixels(const EyeView& view, PixelRect, std::span<const PixelIndex> pixels,
                                   EyeImage& image) const {
    for (const PixelIndex p : pixels) castPixel(mScene, view, p.x, p.y, image);
}
bool TerrainRenderer::mayHitBeyondEdge(const EyeView&, PixelRect, double, double) const {
    return false;
}
bool TerrainRenderer::viewDependent() const {
    return false;
}
void TerrainRenderer::shadeAgain(const EyeView&, int, int, int, EyeImage&) const {}
SimdTarget TerrainRenderer::target() const {
    return SimdTarget::Plain;
}

}  // namespace stereonav
