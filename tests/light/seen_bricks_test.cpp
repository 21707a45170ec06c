// The bricks that a picture's lookups touch, against every pixel's own eight texels.
#include "engine/light/transfer/seen_bricks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/camera/stereo_rig.h"

namespace stereonav {
namespace {

TEST(BricksSeen, holdAllTexelsOfLookupsAndLittleElse) {
    VolumeFrame frame;
    frame.size = {50, 41, 33};
    frame.spacing = {0.01, 0.012, 0.009};
    const IlluminationVolume light(frame);
    Pose head;
    head.position = {0.25, 0.2, 1.0};
    Lens lens;
    lens.width = 60;
    lens.height = 50;
    lens.verticalFov = 0.5;
    const EyeView view = makeEyeView(head, lens);
    EyeImage image;
    image.resize(60, 50);
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 60; ++x)
            image.viewDepth.at(x, y) =
                x < 15 ? kMissDepth : 0.85f + 0.05f * std::sin(0.2f * static_cast<float>(x + y));
    const std::vector<std::uint32_t> bricks = bricksSeen(view, image, light, 1);
    const std::set<std::uint32_t> numbers(bricks.begin(), bricks.end());
    EXPECT_EQ(numbers.size(), bricks.size()) << "no repeats";
    int wanted = 0;
    for (int y = 0; y < 50; ++y)
        for (int x = 15; x < 60; ++x) {
            const double depth = image.viewDepth.at(x, y);
            const glm::dvec3 texel =
                frame.voxelFromWorld(view.eye + depth * view.rayDirection(x + 0.5, y + 0.5));
            for (int corner = 0; corner < 8; ++corner) {
                const glm::ivec3 at = glm::clamp(
                    glm::ivec3(glm::floor(texel)) + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2),
                    glm::ivec3(0), frame.size - 1);
                const glm::ivec3 b = at / 8;
                ASSERT_TRUE(numbers.count(static_cast<std::uint32_t>(
                    (b.z * light.layout.bricks.y + b.y) * light.layout.bricks.x + b.x)));
                ++wanted;
            }
        }
    EXPECT_GT(wanted, 10000);
    EXPECT_LT(bricks.size(), light.layout.count() / 512);
    for (int y = 0; y < 50; ++y) std::fill_n(image.viewDepth.row(y), 60, kMissDepth);
    EXPECT_TRUE(bricksSeen(view, image, light).empty());
}

}  // namespace
}  // namespace stereonav
