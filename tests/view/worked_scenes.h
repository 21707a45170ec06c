// Scenes of one wall for tests of the thread beside the window, with functions to ask and wait for its
// frames.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "app/view/worker.h"
#include "engine/frame/cast_frames.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_scene.h"

namespace stereonav {

// A wall at one view depth, whose colour is the whole metres of the eye's height. Its pictures wait at a
// gate.
class Wall : public EyeRenderer {
public:
    int tileCount(const EyeView&) const override { return 1; }
    void renderTile(const EyeView& view, int, EyeImage& image) const override {
        ++begun;
        test::waitFor([&] { return open.load(); });
        for (int y = 0; y < view.height; ++y) paint(view, y, 0, view.width, image);
    }
    void renderPixels(const EyeView& view, PixelRect, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override {
        for (const PixelIndex& p : pixels) paint(view, p.y, p.x, p.x + 1, image);
    }
    bool mayHitBeyondEdge(const EyeView&, PixelRect, double, double) const override { return false; }

    static constexpr float kDepth = 100.0f;
    mutable std::atomic<int> begun = 0;
    std::atomic<bool> open = true;

private:
    static void paint(const EyeView& view, int y, int x0, int x1, EyeImage& image) {
        for (int x = x0; x < x1; ++x) {
            image.color.at(x, y) = static_cast<PackedColor>(view.eye.z);
            image.viewDepth.at(x, y) = kDepth;
        }
    }
};

inline FakeParts partsOf(std::shared_ptr<Wall> wall) {
    FakeParts scene;
    struct Cast {
        std::shared_ptr<Wall> wall;
        CastFrames frames;
    };
    CastFrames frames(*wall);
    auto cast = std::make_shared<Cast>(Cast{std::move(wall), std::move(frames)});
    scene.frames = &cast->frames;
    scene.owner = std::move(cast);
    return scene;
}

inline OpenScene sceneOf(std::shared_ptr<Wall> wall, const std::string& name = "") {
    FakeParts parts = partsOf(std::move(wall));
    parts.name = name;
    return openOf(parts);
}

inline FrameRequest requestAt(long long version, double height) {
    FrameRequest request;
    request.version = version;
    request.pose.position = {0, 0, height};
    request.pose = poseFromAngles(request.pose.position, 0, 0, 0);
    request.lens.width = 40;
    request.lens.height = 20;
    request.stereo = {2.0, 50.0};
    request.way.method = "full";
    return request;
}

inline std::shared_ptr<const ViewFrame> nextFrame(ViewWorker& worker) {
    return test::waitFor([&] { return worker.takeFrame(); });
}

// Lets the only thread that makes frames turn: after these requests it has also done its own work.
inline void letItTurn(ViewWorker& worker) {
    for (int n = 0; n < 20; ++n) {
        const auto ran = std::make_shared<std::atomic<bool>>(false);
        worker.ask([ran](const OpenScene&) { *ran = true; });
        ASSERT_TRUE(test::waitFor([&] { return ran->load(); }));
    }
}

// Expects no frame after the picture has been measured, which is the first thing done at rest.
inline void expectNoMoreAtRest(ViewWorker& worker, long long version) {
    ASSERT_TRUE(test::waitFor([&] {
        const auto truth = worker.takeTruth();
        return truth && truth->version == version;
    }));
    letItTurn(worker);
    EXPECT_EQ(worker.takeFrame(), nullptr);
}

}  // namespace stereonav
