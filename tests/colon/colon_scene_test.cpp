// Opening studies: the built-in colon, the real anatomy, and volumes that are seen from outside.
#include "colon/scene/colon_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>

#include "colon/scene/colon_cache.h"
#include "colon/scene/isosurface_scene.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::Contains;
using testing::HasSubstr;

fs::path dataFile(const std::string& name) {
    const char* given = std::getenv("STEREONAV_TEST_DATA");
    const fs::path folder = given ? fs::path(given) : fs::path(STEREONAV_SOURCE_DIR) / "../shared/data";
    return folder / name;
}

// A cache folder of its own for each test.
class ColonSceneTest : public ::testing::Test {
protected:
    void SetUp() override {
        mFolder = fs::temp_directory_path() /
                  ("stereonav-scene-" +
                   std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(mFolder);
        fs::create_directories(mFolder);
        if (const char* before = std::getenv("XDG_CACHE_HOME")) mBefore = before;
        setenv("XDG_CACHE_HOME", mFolder.c_str(), 1);
    }
    void TearDown() override {
        mBefore.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", mBefore.c_str(), 1);
        fs::remove_all(mFolder);
    }
    static ColonScene open(const ColonOptions& options) {
        Progress progress;
        return loadColon(options, progress);
    }
    fs::path mFolder;
    std::string mBefore;
};

void expectFlyable(const ColonScene& scene) {
    ASSERT_GT(scene.path.samples().size(), 10u);
    int near = 0, count = 0;
    for (const PathSample& sample : scene.path.samples()) {
        ++count;
        const double room = scene.freeDistanceAt(sample.pose.position, 1.0);
        EXPECT_GT(room, 0) << "sample " << count;
        near += room < scene.clearance;
    }
    EXPECT_LE(near, count / 10);  // only in narrow parts
    EXPECT_GT(scene.stereo.separation, 0);
    EXPECT_NEAR(scene.stereo.zeroParallax / scene.stereo.separation, 30, 1e-6);
    EXPECT_GT(scene.freeDistanceAt(scene.startPose.position, 1.0), 0);
}

TEST_F(ColonSceneTest, BuiltInOpensAndOpensAgainTheSame) {
    ColonOptions options;
    options.builtIn.size = {128, 128, 103};
    const ColonScene cold = open(options), warm = open(options);
    ASSERT_TRUE(cold.isColon());
    EXPECT_GE(cold.polyps.size(), 10u);
    EXPECT_GT(cold.centreline.length(), 1.1);
    expectFlyable(cold);
    ASSERT_EQ(warm.centreline.points.size(), cold.centreline.points.size());
    EXPECT_EQ(warm.volume.cells.records.size(), cold.volume.cells.records.size());
    for (std::size_t n = 0; n < warm.volume.cells.records.size(); ++n)
        ASSERT_EQ(std::memcmp(&warm.volume.cells.records[n], &cold.volume.cells.records[n], 48), 0) << n;
    EXPECT_EQ(warm.notes, cold.notes);
}

TEST_F(ColonSceneTest, TranslucentWallHasMoreCells) {
    ColonOptions options;
    options.builtIn.size = {96, 96, 77};
    const ColonScene opaque = open(options);
    options.opacity = 0.95;
    const ColonScene translucent = open(options);
    EXPECT_GT(translucent.volume.cells.records.size(), opaque.volume.cells.records.size());
    EXPECT_FALSE(translucent.volume.look.transfer.empty());
}

TEST_F(ColonSceneTest, AWallOfWhichNothingIsSeenIsSaid) {
    ColonOptions options;
    options.builtIn.size = {96, 96, 77};
    options.transfer = "curve:5000:1:1:1:0,6000:1:1:1:1";
    const ColonScene dark = open(options);
    EXPECT_THAT(dark.warning, HasSubstr("this curve shows nothing here"));
    EXPECT_THAT(dark.notes, Contains(dark.warning));
    options.transfer = "wall_glass";
    Progress progress;
    const ColonScene glass = changedScene(dark, options, progress);
    EXPECT_EQ(glass.warning, "");
    EXPECT_EQ(open(options).warning, "");
    // Changed in the window.
    options.transfer = "curve:5000:1:1:1:0,6000:1:1:1:1";
    EXPECT_EQ(changedScene(glass, options, progress).warning, dark.warning);
}

using ColonSceneFullSize = ColonSceneTest;
TEST_F(ColonSceneFullSize, RealMaskOpensColdAndFromTheCache) {
    ColonOptions options;
    options.study = dataFile("colon/gca00020/large_intestine_mask_clean.nrrd");
    if (!fs::exists(options.study)) GTEST_SKIP() << options.study << " is not there";
    Stopwatch watch;
    const ColonScene cold = open(options);
    const double cold_ms = watch.lap_ms();
    const ColonScene warm = open(options);
    const double warm_ms = watch.lap_ms();
    std::printf("opened in %.0f ms cold, %.0f ms from the cache\n", cold_ms, warm_ms);
    expectFlyable(cold);
    EXPECT_NEAR(cold.centreline.length(), 2.39, 0.12);
    EXPECT_EQ(warm.volume.cells.records.size(), cold.volume.cells.records.size());
}

TEST_F(ColonSceneTest, VolumesThatAreNotCtAreShownFromOutside) {
    for (const char* name : {"ct/engine.nii.gz", "ct/headsq/quarter.nhdr", "ct/bonsai.nii.gz"}) {
        ColonOptions options;
        options.study = dataFile(name);
        if (!fs::exists(options.study)) GTEST_SKIP() << options.study << " is not there";
        const ColonScene scene = open(options);
        EXPECT_FALSE(scene.isColon()) << name;
        EXPECT_GT(scene.volume.cells.active, 1000u) << name;
        ASSERT_FALSE(scene.notes.empty());
        for (const std::string& note : scene.notes) std::printf("%s: %s\n", name, note.c_str());
        for (const PathSample& sample : scene.path.samples())
            EXPECT_GT(scene.freeDistanceAt(sample.pose.position, 10), 0);
    }
}

GreyVolume ball(double inside, double outside) {
    VolumeFrame frame;
    frame.size = {24, 20, 22};
    frame.spacing = glm::dvec3(0.001);
    GreyVolume grey(frame);
    for (int k = 0; k < 22; ++k)
        for (int j = 0; j < 20; ++j)
            for (int i = 0; i < 24; ++i)
                grey.at(i, j, k) = static_cast<std::int16_t>(
                    glm::length(glm::dvec3(i, j, k) - glm::dvec3(12, 10, 11)) < 7 ? inside : outside);
    return grey;
}

TEST(IsosurfaceScene, IsovalueLiesBetweenTheTwoKinds) {
    const IsovalueChoice choice = chooseIsovalue(ball(180, 20));
    EXPECT_GT(choice.isovalue, 20);
    EXPECT_LT(choice.isovalue, 180);
    EXPECT_EQ(chooseIsovalue(ball(700, -1000)).isovalue, 300);
    EXPECT_EQ(chooseIsovalue(ball(60, -1000)).isovalue, -300);
}

TEST(IsosurfaceScene, IsovalueIsChangedAndRefused) {
    Progress progress;
    ColonScene scene = isosurfaceScene(ball(180, 20), {}, progress);
    setSurface(scene, 150, {}, progress);
    EXPECT_FLOAT_EQ(scene.volume.cells.isovalue, 150);
    EXPECT_THROW(setSurface(scene, 500, {}, progress), Error);
    EXPECT_THROW(setSurface(scene, std::nan(""), {}, progress), Error);
    EXPECT_FLOAT_EQ(scene.volume.cells.isovalue, 150);
    for (const PathSample& sample : scene.path.samples())
        EXPECT_GT(glm::length(sample.pose.position - glm::dvec3(0.012, 0.010, 0.011)), 0.015);
}

// Another look at the same study: its voxels are where they were, what does not change is not made again, and
// what does is as if it had been opened so.
TEST(IsosurfaceScene, IsChangedWithoutItsVoxels) {
    Progress progress;
    const ColonScene scene = isosurfaceScene(ball(180, 20), {}, progress);
    ColonOptions options;
    const ColonScene same = changedScene(scene, options, progress);
    EXPECT_EQ(same.volume.field.values.data(), scene.volume.field.values.data());
    EXPECT_EQ(same.volume.cells.records.data(), scene.volume.cells.records.data());
    options.isovalue = 120;
    const ColonScene moved = changedScene(scene, options, progress);
    EXPECT_EQ(moved.volume.field.values.data(), scene.volume.field.values.data());
    EXPECT_FLOAT_EQ(moved.volume.cells.isovalue, 120);
    EXPECT_EQ(moved.startPose.position, scene.startPose.position);
    options.opacity = 0.3;
    const ColonScene glass = changedScene(moved, options, progress);
    const ColonScene opened = isosurfaceScene(ball(180, 20), options, progress);
    EXPECT_EQ(glass.volume.look.transfer, opened.volume.look.transfer);
    ASSERT_EQ(glass.volume.cells.records.size(), opened.volume.cells.records.size());
    EXPECT_EQ(std::memcmp(glass.volume.cells.records.data(), opened.volume.cells.records.data(),
                          opened.volume.cells.records.size() * sizeof(CellRecord)),
              0);
    EXPECT_EQ(scene.volume.cells.isovalue, same.volume.cells.isovalue) << "the first one is as it was";
    EXPECT_TRUE(scene.volume.look.transfer.empty());
    options.isovalue = 1000;
    EXPECT_THROW(changedScene(glass, options, progress), Error);
}

TEST(IsosurfaceScene, SurfaceIsClosedAtTheVolumesFaces) {
    Progress progress;
    GreyVolume full = ball(180, 20);
    std::fill_n(&full.values[0], full.frame.count(), std::int16_t{180});
    full.at(0, 0, 0) = 20;
    const ColonScene scene = isosurfaceScene(std::move(full), {}, progress);
    // Six faces of a box of 24 x 20 x 22 voxels, one cell each and more along the edges.
    EXPECT_GT(scene.volume.cells.active, 2u * (23 * 19 + 23 * 21 + 19 * 21));
}

}  // namespace
}  // namespace stereonav
