// The many-ray truth against a picture whose exact pixel averages are known.
#include "engine/metrics/supersampled_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/frame/cast_frames.h"
#include "tests/support/whole_progress.h"

namespace stereonav {
namespace {

// Linear brightness grows from 0 to 1 across the view's window plane, from u = -1 to u = 1, in the red
// channel, and is 1 above the middle and 0 below it in the green one. One ray is one exact sample.
class RampRenderer final : public EyeRenderer {
public:
    int tileCount(const EyeView&) const override { return 1; }
    void renderTile(const EyeView& view, int, EyeImage& image) const override {
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
                const auto red = static_cast<float>(std::clamp(0.5 + 0.5 * ray.x, 0.0, 1.0));
                image.color.at(x, y) = packColor({red, ray.y > 0.0 ? 1.0f : 0.0f, 0.0f});
                image.viewDepth.at(x, y) = 1.0f;
            }
        mWidest = std::max(mWidest, view.width);
    }
    void renderPixels(const EyeView&, PixelRect, std::span<const PixelIndex>, EyeImage&) const override {}
    bool mayHitBeyondEdge(const EyeView&, PixelRect, double, double) const override { return false; }

    mutable int mWidest = 0;  // pixels of the widest strip seen
};

EyeView viewOf(int width, int height) {
    EyeView view;
    view.width = width;
    view.height = height;
    return view;
}

TEST(SupersampledPicture, AveragesInLinearLight) {
    const RampRenderer renderer;
    Progress progress;
    // 3 rows: the middle one is half covered, so half the light, not half the code value
    const auto picture = renderSupersampled(renderer, viewOf(7, 3), 4, progress);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 7; ++x) {
            const glm::vec3 linear = unpackColor(picture.at(x, y));
            EXPECT_NEAR(linear.x, (x + 0.5) / 7, 2e-3) << x << " " << y;
            EXPECT_NEAR(linear.y, y == 0 ? 1.0 : y == 1 ? 0.5 : 0.0, 2e-3) << x << " " << y;
        }
}

TEST(SupersampledPicture, TellsAWholeProgress) {
    const RampRenderer renderer;
    CastFrames frames(renderer);
    for (const bool narrow : {true, false}) {
        const EyeView view =
            narrow ? viewOf(7, 3) : viewOf(3, 200'000);  // a strip of its own for each column
        test::expectWholeProgress("with a renderer", narrow ? 0 : 2, [&](Progress& progress) {
            renderSupersampled(renderer, view, 4, progress);
        });
        test::expectWholeProgress("with a maker of frames", narrow ? 0 : 2, [&](Progress& progress) {
            renderSupersampled(frames, view, 0, 4, progress);
        });
    }
}

TEST(SupersampledPicture, StripsJoinWithoutASeam) {
    const RampRenderer renderer;
    Progress progress;
    const EyeView view = viewOf(301, 2000);  // 8 M rays at factor 4, two and more strips
    const auto picture = renderSupersampled(renderer, view, 4, progress);
    EXPECT_LT(renderer.mWidest, 301 * 4) << "one strip holds the whole picture";
    for (int x = 0; x < view.width; ++x)
        ASSERT_NEAR(unpackColor(picture.at(x, 1000)).x, (x + 0.5) / view.width, 2e-3) << x;
}

TEST(SupersampledPicture, ChecksItsFactorAndCanBeStopped) {
    const RampRenderer renderer;
    Progress progress;
    EXPECT_THROW(renderSupersampled(renderer, viewOf(4, 4), 0, progress), Error);
    EXPECT_THROW(renderSupersampled(renderer, viewOf(4, 4), 17, progress), Error);
    progress.cancel();
    EXPECT_THROW(renderSupersampled(renderer, viewOf(4, 4), 2, progress), Cancelled);
}

}  // namespace
}  // namespace stereonav
