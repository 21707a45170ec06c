#include "engine/mesh/mesh_renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace stereonav {
namespace {

constexpr int kTile = 32;  // pixels a side
constexpr int kBlock = 4;  // pixels a side: rays of one packet stay close together

int tilesAcross(int pixels) {
    return (pixels + kTile - 1) / kTile;
}

}  // namespace

glm::vec3 meshBackground(const glm::dvec3& direction) {
    constexpr glm::vec3 kBelow(0.22f), kAbove(0.06f);
    const double up = direction.z / glm::length(direction);
    return glm::mix(kBelow, kAbove, static_cast<float>(0.5 + 0.5 * up));
}

int MeshRenderer::tileCount(const EyeView& view) const {
    return tilesAcross(view.width) * tilesAcross(view.height);
}

void MeshRenderer::renderTile(const EyeView& view, int tile, EyeImage& image) const {
    const int across = tilesAcross(view.width);
    const int left = tile % across * kTile, top = tile / across * kTile;
    const int right = std::min(left + kTile, view.width), bottom = std::min(top + kTile, view.height);
    const MeshRays rays(mCaster, view);
    PixelIndex block[kBlock * kBlock];
    for (int y0 = top; y0 < bottom; y0 += kBlock)
        for (int x0 = left; x0 < right; x0 += kBlock) {
            std::size_t count = 0;
            for (int y = y0; y < std::min(y0 + kBlock, bottom); ++y)
                for (int x = x0; x < std::min(x0 + kBlock, right); ++x)
                    block[count++] = {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
            castBatch(rays, view, {block, count}, image);
        }
}

void MeshRenderer::renderPixels(const EyeView& view, PixelRect, std::span<const PixelIndex> pixels,
                                EyeImage& image) const {
    castBatch(MeshRays(mCaster, view), view, pixels, image);
}

void MeshRenderer::castBatch(const MeshRays& rays, const EyeView& view, std::span<const PixelIndex> pixels,
                             EyeImage& image) const {
    glm::dvec3 direction[MeshCaster::kMostRays];
    float farDepth[MeshCaster::kMostRays];
    MeshHit hits[MeshCaster::kMostRays];
    std::fill(std::begin(farDepth), std::end(farDepth), kMissDepth);
    const auto packet = static_cast<std::size_t>(mCaster.packet());
    for (std::size_t first = 0; first < pixels.size(); first += packet) {
        const std::size_t count = std::min(packet, pixels.size() - first);
        for (std::size_t k = 0; k < count; ++k)
            direction[k] = view.rayDirection(pixels[first + k].x + 0.5, pixels[first + k].y + 0.5);
        const bool any = rays.cast(direction, farDepth, static_cast<int>(count), hits);
        for (std::size_t k = 0; k < count; ++k) {
            const PixelIndex p = pixels[first + k];
            const bool hit = any && hits[k].triangle != MeshHit::kNone;
            image.viewDepth.at(p.x, p.y) = hit ? static_cast<float>(hits[k].t) : kMissDepth;
            image.color.at(p.x, p.y) =
                packColor(hit ? colorOf(mCaster.mesh(), hits[k], direction[k], view.pixelHeight(), mLight)
                              : meshBackground(direction[k]));
        }
    }
}

bool MeshRenderer::mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                                    double parallaxScale) const {
    const double farthest =
        rect.x1 < column ? parallaxScale / (column - rect.x1) : std::numeric_limits<double>::infinity();
    return MeshRays(mCaster, view).mayMeetBefore(farthest, rect);
}

}  // namespace stereonav
