// Holes cast without coherence: every pixel once, nothing known beside it, and the same picture.
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "app/report/coherence.h"
#include "engine/stereo/right_eye.h"
#include "tests/support/analytic_scene.h"

namespace stereonav {
namespace {

// Looks at what it is handed.
class Watched final : public test::AnalyticScene {
public:
    using AnalyticScene::AnalyticScene;
    mutable std::vector<std::pair<int, int>> cast;
    mutable bool knew = false, dense = false;

    void renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override {
        for (int y = bounds.y0; y < bounds.y1; ++y)
            for (int x = bounds.x0; x < bounds.x1; ++x) knew = knew || image.viewDepth.at(x, y) != 0;
        for (std::size_t n = 0; n < pixels.size(); ++n) {
            cast.emplace_back(pixels[n].x, pixels[n].y);
            for (std::size_t k = 0; k < n; ++k)
                dense = dense ||
                        (std::abs(pixels[n].x - pixels[k].x) < 2 && std::abs(pixels[n].y - pixels[k].y) < 2);
        }
        AnalyticScene::renderPixels(view, bounds, pixels, image);
    }
};

const Lens kLens{90, 60, 0.8, 1.0, 0.1};

TEST(WithoutCoherence, HandsOutEveryPixelOnceWithNothingKnownBesideIt) {
    const Watched scene({test::sphere({0, 8, 0}, 1.0), test::plane({0, 20, 0}, {0, -1, 0})}, 0.7);
    const StereoViews views = makeStereoViews(poseFromAngles({0, 0, 0}, 0, 0, 0), kLens, {0.4, 10.0});
    EyeImage image;
    image.resize(90, 60);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 90; ++x) image.viewDepth.at(x, y) = 7;  // what must not be seen
    std::vector<PixelIndex> pixels;
    for (int y = 10; y < 40; ++y)
        for (int x = 20; x < 70; x += y % 3 == 0 ? 1 : 5)
            pixels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    WithoutCoherence(scene).renderPixels(views.right, {20, 10, 70, 40}, pixels, image);
    EXPECT_FALSE(scene.knew);
    EXPECT_FALSE(scene.dense) << "pixels side by side may be led by one another";
    EXPECT_EQ(scene.cast.size(), pixels.size());
    std::set<std::pair<int, int>> asked;
    for (const PixelIndex p : pixels) asked.insert({p.x, p.y});
    const std::set<std::pair<int, int>> cast(scene.cast.begin(), scene.cast.end());
    EXPECT_EQ(cast, asked);
    EXPECT_EQ(image.viewDepth.at(0, 0), 7) << "other pixels stay as they are";
}

TEST(WithoutCoherence, MakesTheSamePicture) {
    const test::AnalyticScene scene({test::sphere({0, 8, 0}, 1.0), test::plane({0, 20, 0}, {0, -1, 0})}, 0.7);
    const WithoutCoherence alone(scene);
    const StereoViews views = makeStereoViews(poseFromAngles({0, 0, 0}, 0, 0, 0), kLens, {0.4, 10.0});
    EyeImage left, a, b;
    left.resize(90, 60);
    renderEye(scene, views.left, left);
    WarpSetting setting;
    setting.method = RightEyeMethod::Paper;
    RightEye eye;
    const long long holes = eye.render(scene, views, left, setting, a).holePixels;
    EXPECT_EQ(eye.render(alone, views, left, setting, b).holePixels, holes);
    ASSERT_GT(holes, 0);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 90; ++x) {
            EXPECT_EQ(a.color.at(x, y), b.color.at(x, y)) << x << " " << y;
            EXPECT_EQ(a.viewDepth.at(x, y), b.viewDepth.at(x, y)) << x << " " << y;
        }
}

}  // namespace
}  // namespace stereonav
