// Pictures of every size from none to 16,384 pixels wide, of a terrain and of a lumen, by every method.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "engine/stereo/right_eye.h"
#include "engine/volume/plain_volume_caster.h"
#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/stability_row.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using namespace test;

struct Size {
    int width, height;
    std::string text() const { return std::to_string(width) + "x" + std::to_string(height); }
};

class RefusedSizeRow : public testing::TestWithParam<Size> {};

TEST_P(RefusedSizeRow, IsRefusedInOneClearLine) {
    const Size size = GetParam();
    StabilityRow row("image/refused/" + size.text(), "a picture of " + size.text() + " pixels",
                     "taken on, or refused without saying what was got", 0, "times");
    row.count(0);
    for (const bool stereo : {false, true}) {
        std::string message;
        try {
            const Lens lens{size.width, size.height, 0.8, 1.0, 0.1};
            stereo ? static_cast<void>(makeStereoViews({}, lens, {}))
                   : static_cast<void>(makeEyeView({}, lens));
        } catch (const Error& error) {
            message = error.what();
        }
        row.count(message.find(size.text()) == std::string::npos || message.find('\n') != std::string::npos);
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, RefusedSizeRow,
                         testing::Values(Size{0, 0}, Size{0, 7}, Size{7, 0}, Size{-1, 4}, Size{32769, 1},
                                         Size{1, 2147483647}),
                         [](const auto& given) { return testName(given.param.text()); });

// ---- pictures that are made

struct Stage {
    TerrainScene terrain = makeScene(makeGround("smooth", 65, 65, 1));
    VolumeScene volume =
        surfaceScene(walledVolume(
                         frameOf({41, 41, 41}, glm::dvec3(0.001)),
                         [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(0.02)) - 0.015; }, 3e5),
                     -480);
    TerrainRenderer ground{terrain};
    VolumeRenderer lumen{volume};
};
const Stage& stage() {
    static const Stage kStage;
    return kStage;
}

class SizeRow : public testing::TestWithParam<Size> {
protected:
    // A field of view that keeps both sides of even the longest strip below 100 degrees.
    static Lens lensOf(const Size& size, double nearDepth) {
        const double wide = std::max(1.0, static_cast<double>(size.width) / size.height);
        return {size.width, size.height, 2 * std::atan(1.1 / wide), 1.0, nearDepth};
    }
    // Pixels of the filled methods whose depth is none, and of the full cast whose depth is not the plain
    // walk's; every few of the large pictures.
    template <typename Plain>
    static void check(const EyeRenderer& renderer, const StereoViews& views, const Plain& plain,
                      StabilityRow& row) {
        const EyeImage left = castPicture(renderer, views.left);
        for (const NamedMethod& named : kRightEyeMethods) {
            WarpSetting setting;
            setting.method = named.method;
            RightEye eye;
            EyeImage right;
            eye.render(renderer, views, left, setting, right);
            const bool leavesHoles =
                named.method == RightEyeMethod::McMillan || named.method == RightEyeMethod::NoFill;
            for (int y = 0; y < right.height(); ++y)
                for (int x = 0; x < right.width(); ++x) {
                    const float depth = right.viewDepth.at(x, y);
                    row.count(!(depth > 0 || (leavesHoles && depth == 0)));
                }
        }
        const int step = std::max(1, left.width() * left.height() / 4000);
        for (int n = 0; n < left.width() * left.height(); n += step) {
            const int x = n % left.width(), y = n / left.width();
            const double truth = plain(views.left, x + 0.5, y + 0.5), got = left.viewDepth.at(x, y);
            row.count(!(got == truth || std::abs(got - truth) <= 1e-4 * truth));
        }
    }
};

TEST_P(SizeRow, TerrainIsSound) {
    const Size size = GetParam();
    StabilityRow row("image/terrain/" + size.text(), "a terrain in " + size.text() + " pixels, all methods",
                     "pixels without a depth or with another than the plain walk's", 0, "pixels");
    row.count(0);
    const Stage& s = stage();
    const Pose head = poseFromAngles({100, -300, s.terrain.ground.maxHeight() + 30.0}, 0.3, -0.5, 0);
    check(
        s.ground, makeStereoViews(head, lensOf(size, 1), {3, 90}),
        [&](const EyeView& view, double x, double y) {
            return castPlain(s.terrain.ground, view.eye, view.rayDirection(x, y), view.nearDepth).t;
        },
        row);
}

TEST_P(SizeRow, LumenIsSound) {
    const Size size = GetParam();
    StabilityRow row("image/colon/" + size.text(), "a lumen in " + size.text() + " pixels, all methods",
                     "pixels without a depth or with another than the plain walk's", 0, "pixels");
    row.count(0);
    const Stage& s = stage();
    const Pose head = poseFromAngles({0.021, 0.02, 0.019}, 0.2, 0.1, 0.3);
    check(
        s.lumen, makeStereoViews(head, lensOf(size, 1e-4), {0.001, 0.02}),
        [&](const EyeView& view, double x, double y) {
            return castPlainVolume(s.volume.field, s.volume.cells.isovalue,
                                   {view.eye, view.rayDirection(x, y), view.nearDepth})
                .t;
        },
        row);
}

INSTANTIATE_TEST_SUITE_P(Stability, SizeRow,
                         testing::Values(Size{1, 1}, Size{1, 2}, Size{2, 1}, Size{1, 97}, Size{97, 1},
                                         Size{15, 3}, Size{17, 3}, Size{16384, 1}, Size{16384, 5},
                                         Size{1, 16384}),
                         [](const auto& given) { return testName(given.param.text()); });

}  // namespace
}  // namespace stereonav
