// Leaps measured in blocks against leaps measured at once: the same cells, never further than is free, and as
// far where the surface is near.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "engine/camera/stereo_rig.h"
#include "engine/render/eye_renderer.h"
#include "engine/volume/surface_cells.h"
#include "engine/volume/transfer_function.h"
#include "engine/volume/volume_renderer.h"
#include "test_volumes.h"

namespace stereonav {
namespace {

using test::greyVolume;
using test::slantedFrame;

constexpr double kReach = 16, kGroupSide = 4;  // the same as in leap_blocks.h

SurfaceCells cellsOf(const GreyVolume& volume, float isovalue, bool blocks,
                     const MaskVolume* region = nullptr) {
    Progress progress;
    SurfaceSetting setting{isovalue, isovalue, isovalue, region};
    if (blocks) setting.atOnce = 0;
    return findSurfaceCells(volume, setting, progress);
}

// Two balls far apart, longer than a block.
GreyVolume balls(const VolumeFrame& frame) {
    const glm::dvec3 a = glm::dvec3(frame.size) * glm::dvec3(0.1, 0.5, 0.4),
                     b = glm::dvec3(frame.size) * glm::dvec3(0.93, 0.4, 0.6);
    return greyVolume(frame, [&](const glm::dvec3& v) {
        return std::max(600 - 60 * glm::distance(v, a), 400 - 50 * glm::distance(v, b));
    });
}

void expectSameCells(const SurfaceCells& blocks, const SurfaceCells& once) {
    ASSERT_EQ(blocks.records.size(), once.records.size());
    ASSERT_GT(once.records.size(), 100u);
    EXPECT_EQ(
        std::memcmp(blocks.records.data(), once.records.data(), once.records.size() * sizeof(CellRecord)), 0);
    EXPECT_EQ(std::memcmp(blocks.places.data(), once.places.data(), once.layout.count() * 2), 0);
    EXPECT_EQ(std::memcmp(blocks.bricks.data(), once.bricks.data(), once.bricks.size() * 4), 0);
}

// Counts far bricks, and expects their cells to have no codes.
void countFarBricks(const SurfaceCells& blocks, std::size_t& far) {
    for (std::size_t n = 0; n < blocks.layout.count(); n += 4096) {
        if (blocks.farCodes[BrickLayout::farIndex(n)] == 0) continue;
        ++far;
        for (std::size_t cell = n; cell < n + 4096; ++cell) ASSERT_EQ(blocks.codes[cell], 0);
    }
}

void expectLeapsBelow(const SurfaceCells& blocks, const SurfaceCells& once) {
    const glm::dvec3& s = once.frame.spacing;
    const double smallest = std::min({s.x, s.y, s.z}), group = 2 * kGroupSide * glm::length(s);
    int beyond = 0;
    for (int k = 0; k < once.frame.size.z - 1; ++k)
        for (int j = 0; j < once.frame.size.y - 1; ++j)
            for (int i = 0; i < once.frame.size.x - 1; ++i) {
                const std::size_t n = once.layout.index(i, j, k);
                const int exact = once.codes[n], code = blocks.code({i, j, k});
                ASSERT_EQ(exact == kCellActive, code == kCellActive);
                if (exact == kCellActive) continue;
                // Both are rounded down by less than a unit.
                const double least = (exact - 1) * once.leapUnit, most = exact * once.leapUnit;
                const double free = (code - 1) * blocks.leapUnit;
                ASSERT_LT(free, most) << i << " " << j << " " << k;
                const double known = std::min(least, std::max(kReach * smallest, least - group));
                ASSERT_GT(free + blocks.leapUnit, known * (1 - 1e-9)) << i << " " << j << " " << k;
                beyond += least > kReach * smallest;
            }
    EXPECT_GT(beyond, 1000);
}

TEST(LeapBlocks, AreTheSameCellsAndLeapNoFurther) {
    VolumeFrame frame;
    frame.size = {300, 45, 50};
    frame.spacing = glm::dvec3(0.7e-3);
    const GreyVolume volume = balls(frame);
    const SurfaceCells once = cellsOf(volume, 100, false), blocks = cellsOf(volume, 100, true);
    expectSameCells(blocks, once);
    expectLeapsBelow(blocks, once);
}

TEST(LeapBlocks, OfUnevenSpacing) {
    const GreyVolume volume = balls(slantedFrame({47, 41, 290}));
    const SurfaceCells once = cellsOf(volume, 50, false), blocks = cellsOf(volume, 50, true);
    expectSameCells(blocks, once);
    expectLeapsBelow(blocks, once);
}

// Rays start in the region and end at its wall: what lies behind the wall has neither codes nor records.
TEST(LeapBlocks, KeepToARegion) {
    VolumeFrame frame;
    frame.size = {300, 96, 99};
    frame.spacing = glm::dvec3(0.7e-3);
    const glm::dvec3 middle(150, 48, 48);
    // Two hollows, of which the region is one; the other comes near to it.
    const GreyVolume volume = greyVolume(frame, [&](const glm::dvec3& v) {
        const glm::dvec3 way = (v - middle) / glm::dvec3(130, 44, 46);
        const double other = glm::distance(v, glm::dvec3(287, 48, 48)) - 4;
        return 100 + 500 * std::min(glm::length(way) - 1, 0.02 * other);
    });
    MaskVolume region(frame);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < 282; ++i) region.at(i, j, k) = volume.at(i, j, k) < 100;
    const SurfaceCells once = cellsOf(volume, 100, false, &region),
                       blocks = cellsOf(volume, 100, true, &region);
    expectSameCells(blocks, once);
    expectLeapsBelow(blocks, once);
    std::size_t far = 0;
    countFarBricks(blocks, far);
    EXPECT_GT(far, 8u);
    for (const double x : {21.0, 40.0, 150.0, 222.0, 278.0}) {
        const glm::dvec3 at = frame.worldFromVoxel({x, 48.2, 48.1});
        EXPECT_NEAR(freeDistance(blocks, at, 1, 1e-6), freeDistance(once, at, 1, 1e-6), 2e-6) << x;
    }
}

TEST(LeapBlocks, WithoutSurfaceLeapAsFarAsACodeCan) {
    VolumeFrame frame;
    frame.size = {40, 20, 30};
    const SurfaceCells cells = cellsOf(GreyVolume(frame), 100, true);
    EXPECT_EQ(cells.active, 0u);
    EXPECT_EQ(cells.code({20, 10, 15}), 255);
    EXPECT_EQ(cells.code({38, 18, 28}), 255);
}

TEST(LeapBlocks, OfTwoVoxels) {
    VolumeFrame frame;
    frame.size = glm::ivec3(2);
    GreyVolume volume(frame);
    volume.at(1, 1, 1) = 200;
    const SurfaceCells cells = cellsOf(volume, 100, true);
    ASSERT_EQ(cells.records.size(), 1u);
    EXPECT_EQ(cells.record({0, 0, 0})->values[7], 200);
}

TEST(LeapBlocks, DoNotDependOnThreads) {
    VolumeFrame frame;
    frame.size = {60, 70, 50};
    const GreyVolume volume = balls(frame);
    const int threads = threadCount();
    const SurfaceCells many = cellsOf(volume, 100, true);
    setThreadCount(threads == 1 ? 3 : 1);
    const SurfaceCells other = cellsOf(volume, 100, true);
    setThreadCount(threads);
    EXPECT_EQ(std::memcmp(many.codes.data(), other.codes.data(), many.layout.count()), 0);
    ASSERT_EQ(many.farCodes.size(), other.farCodes.size());
    EXPECT_EQ(std::memcmp(many.farCodes.data(), other.farCodes.data(), many.farCodes.size()), 0);
    expectSameCells(many, other);
}

VolumeScene ballScene() {
    VolumeFrame frame;
    frame.size = {120, 60, 60};
    frame.spacing = glm::dvec3(1e-3);
    frame.origin = glm::dvec3(-0.06, -0.03, -0.03);
    VolumeScene scene;
    scene.field = balls(frame);
    return scene;
}

EyeImage pictureOf(const VolumeScene& scene, SimdTarget target) {
    Lens lens;
    lens.width = 160;
    lens.height = 120;
    lens.nearDepth = 0.001;
    const EyeView view =
        makeStereoViews(poseFromAngles({0.01, -0.13, 0.01}, 0, 0, 0), lens, {0.004, 0.13}).left;
    const VolumeRenderer renderer(scene, {.target = target});
    EyeImage picture;
    picture.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, picture);
    return picture;
}

void expectSamePictures(const EyeImage& a, const EyeImage& b) {
    int hits = 0;
    for (int y = 0; y < a.color.height(); ++y)
        for (int x = 0; x < a.color.width(); ++x) {
            ASSERT_EQ(a.viewDepth.at(x, y), b.viewDepth.at(x, y)) << x << " " << y;
            ASSERT_EQ(a.color.at(x, y), b.color.at(x, y)) << x << " " << y;
            hits += std::isfinite(a.viewDepth.at(x, y));
        }
    EXPECT_GT(hits, 200);
}

TEST(LeapBlocks, ShowTheSamePicture) {
    VolumeScene scene = ballScene();
    scene.cells = cellsOf(scene.field, 100, false);
    const EyeImage once = pictureOf(scene, SimdTarget::Auto);
    scene.cells = cellsOf(scene.field, 100, true);
    expectSamePictures(once, pictureOf(scene, SimdTarget::Auto));
}

// The same codes, all of them the cells' own.
SurfaceCells withOwnCodes(const SurfaceCells& cells) {
    SurfaceCells own = cells.share();
    own.codes = LazyArray<std::uint8_t>(cells.layout.count());
    own.farCodes = {};
    const glm::ivec3 size = cells.frame.size - 1;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) own.codes[own.layout.index(i, j, k)] = cells.code({i, j, k});
    return own;
}

// What far bricks are kept by is told by nothing that is made of them: surfaces, what is translucent, free
// ways.
TEST(LeapBlocks, FarBricksAreAsIfTheirCellsHadCodes) {
    VolumeScene scene = ballScene();
    const SurfaceCells blocks = cellsOf(scene.field, 100, true), own = withOwnCodes(blocks);
    for (const bool translucent : {false, true})
        for (const SimdTarget target : {SimdTarget::Auto, SimdTarget::Plain}) {
            scene.look.transfer = {};
            if (translucent)
                scene.look.transfer =
                    TransferFunction({{90, {1, 1, 1}, 0}, {300, {1, 0, 0}, 0.1}}, 1e-3, "test");
            scene.cells = own.share();
            const EyeImage expected = pictureOf(scene, target);
            scene.cells = blocks.share();
            expectSamePictures(expected, pictureOf(scene, target));
        }
    for (int i = 0; i <= 20; ++i) {
        const glm::dvec3 at(-0.055 + 0.11 * i / 20, 0.001, 0.002);
        EXPECT_EQ(freeDistance(blocks, at, 1, 1e-5), freeDistance(own, at, 1, 1e-5)) << i;
    }
}

TEST(LeapBlocks, FarBricksTakeNoCodes) {
    const VolumeScene scene = ballScene();
    const SurfaceCells blocks = cellsOf(scene.field, 100, true), own = withOwnCodes(blocks);
    std::size_t far = 0;
    countFarBricks(blocks, far);
    EXPECT_GE(far, 16u);
    EXPECT_LT(far, blocks.layout.count() / 4096 - 8);
    EXPECT_GE(own.bytesHeld(), blocks.bytesHeld() + far * 4096 - blocks.farCodes.size());
}

}  // namespace
}  // namespace stereonav
