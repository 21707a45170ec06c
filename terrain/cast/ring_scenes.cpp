#include "terrain/cast/ring_scenes.h"

#include <algorithm>

#include "engine/base/memory.h"
#include "terrain/cast/caster_scene.h"

namespace stereonav {
namespace {

double bytesBeside(const Heightfield& ground) {
    constexpr double kLevels = 4.0 / 3, kBoxes = 4 * (1 + 4.0 / 3) * 4.0 / 3;  // a sample
    return (kLevels + 2 * kBoxes) * ground.width() * ground.height();
}

}  // namespace

// Levels, and boxes of the finest ones, whose maxima are a third more; those before them are held until they
// are there.
RingScenes::RingScenes(const Heightfield& ground, double share)
    : mLevels((checkMemory("--level-of-detail", bytesBeside(ground), "leave it out"), ground)),
      mShare(share) {}

void RingScenes::lookFrom(const EyeView& view) {
    const RingWish wish{view.eye, std::max(view.pixelWidth(), view.pixelHeight()), mShare};
    std::vector<RingBox> boxes = planRings(mLevels, wish);
    if (boxes == mBoxes) return;
    const bool itself = boxes.size() == 1 && boxes.front().level == 0;
    mRings = itself ? nullptr : makeRings(mLevels, boxes, mRings.get());
    mBoxes = std::move(boxes);
}

void RingScenes::dress(const CasterScene& foggy, const CasterScene& clear) {
    if (!any()) return;
    mFoggy = dressed(foggy);
    mClear = dressed(clear);
}

std::vector<CasterScene> RingScenes::dressed(const CasterScene& whole) const {
    const auto& rings = mRings->rings;
    std::vector<CasterScene> scenes(rings.size(), whole);
    const auto steepest = static_cast<float>(mRings->steepest * (1 + 1e-6));
    for (std::size_t n = 0; n < rings.size(); ++n) {
        const RingBox& box = rings[n]->box;
        CasterScene& scene = scenes[n];
        scene.ground = groundData(rings[n]->ground, rings[n]->maxima);
        // A ray's way is proven free by others that may have gone over any of the rings.
        scene.ground.maxSlope = steepest;
        const auto step = static_cast<float>(1 << box.level);
        TextureData& texture = scene.texture;
        texture.shiftX += static_cast<float>(box.low.x) * step * texture.scaleX;
        texture.shiftY += static_cast<float>(box.low.y) * step * texture.scaleY;
        texture.scaleX *= step;
        texture.scaleY *= step;
        if (box.level > 0)
            scene.detail = {};
        else if (scene.detail.octaves > 0)
            scene.detail.rough +=
                static_cast<std::ptrdiff_t>(box.low.y) * scene.detail.roughPitch + box.low.x;
        if (n + 1 == rings.size()) continue;
        const RingBox& next = rings[n + 1]->box;
        const int ratio = 1 << (next.level - box.level);
        scene.beyond = {&scenes[n + 1], double(next.low.x) * ratio - box.low.x,
                        double(next.low.y) * ratio - box.low.y, 1.0 / ratio};
    }
    return scenes;
}

std::size_t RingScenes::byteCount() const {
    std::size_t bytes = mLevels.byteCount();
    if (mRings)
        for (const auto& ring : mRings->rings)
            bytes += ring->maxima.byteCount() +
                     sizeof(float) * static_cast<std::size_t>(ring->box.size.x) * ring->box.size.y;
    return bytes;
}

}  // namespace stereonav
