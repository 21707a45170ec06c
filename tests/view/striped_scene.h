// A scene of two striped walls, one before the other, whose right eye has holes.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>

#include "engine/frame/cast_frames.h"
#include "engine/image/packed_color.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_scene.h"

namespace stereonav {

// Two walls with stripes at places of the world, the nearer one over a third of the picture: the right eye
// has holes, and a warp that is a little off.
class Stripes : public EyeRenderer {
public:
    static constexpr int kTiles = 40;

    int tileCount(const EyeView&) const override { return kTiles; }
    void renderTile(const EyeView& view, int tile, EyeImage& image) const override {
        const bool right = view.eye.x > 0.1;
        ++tiles;
        ofRightEye += right;
        if (right) test::waitFor([&] { return !holdRight; });
        for (int y = view.height * tile / kTiles; y < view.height * (tile + 1) / kTiles; ++y)
            for (int x = 0; x < view.width; ++x) paint(view, x, y, image);
    }
    void renderPixels(const EyeView& view, PixelRect, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override {
        for (const PixelIndex& p : pixels) paint(view, p.x, p.y, image);
    }
    bool mayHitBeyondEdge(const EyeView&, PixelRect rect, double column, double scale) const override {
        return rect.x1 >= column || scale / (column - rect.x1) > 8;
    }

    mutable std::atomic<int> tiles = 0, ofRightEye = 0;  // tiles that were begun
    std::atomic<bool> holdRight = false;                 // holds tiles of the right eye that are begun

private:
    static void paint(const EyeView& view, int x, int y, EyeImage& image) {
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const double along = glm::dot(ray, view.forward);
        double depth = 20;
        double side = glm::dot(view.eye + ray * (depth / along), view.right);
        const double near = glm::dot(view.eye + ray * (8 / along), view.right);
        if (std::abs(near) < 1.5) depth = 8, side = near;
        const auto grey = static_cast<float>(0.5 + 0.4 * std::sin(9 * side) * std::cos(0.2 * y));
        image.color.at(x, y) = packColor({grey, 0.8f * grey, depth < 10 ? 0.2f : 0.6f});
        image.viewDepth.at(x, y) = static_cast<float>(depth);
    }
};

struct StripedScene {
    std::shared_ptr<Stripes> stripes = std::make_shared<Stripes>();
    std::shared_ptr<CastFrames> frames = std::make_shared<CastFrames>(*stripes);
    FakeParts parts() const {
        FakeParts parts;
        parts.frames = frames.get();
        parts.rays = stripes.get();
        parts.owner = std::make_shared<std::pair<std::shared_ptr<Stripes>, std::shared_ptr<CastFrames>>>(
            stripes, frames);
        return parts;
    }
};

}  // namespace stereonav
