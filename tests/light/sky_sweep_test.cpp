// What is hidden of the sky and of a key light, by sweeps over a coarse grid: shapes whose answer is known,
// and rays that are cast exactly.
#include "engine/light/occlusion/sky_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/math/constants.h"
#include "engine/volume/plain_volume_caster.h"
#include "light_scenes.h"
#include "tests/support/whole_progress.h"

namespace stereonav {
namespace {

using test::ballVolume;
using test::cubeFrame;
using test::solidVolume;

constexpr double kVoxel = 1e-3;

VolumeScene skyScene(GreyVolume field) {
    VolumeScene scene;
    scene.field = std::move(field);
    scene.cells.isovalue = 0;
    return scene;
}

SkyGrid swept(const VolumeScene& scene, SkySweepSetting setting = {}) {
    Progress progress;
    return sweepSky(scene, setting, progress);
}

// A floor up to z = 12 with a box on it, x and y from 24 to 40, up to z = 28.
double floorAndBox(const glm::dvec3& v) {
    const glm::dvec3 beside = glm::abs(v - glm::dvec3(32, 32, 20)) - 8.0;
    return std::max(12 - v.z, -std::max({beside.x, beside.y, beside.z}));
}

// The sky's share by rays with a cosine's density about the normal; what is hit counts by exp(-d / reach),
// where that is given.
double skyByRays(const VolumeScene& scene, const glm::dvec3& voxel, const glm::dvec3& normal, double reach) {
    constexpr int kRays = 512;
    const glm::dvec3 other = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(other, normal)), v = glm::cross(normal, u);
    const glm::dvec3 from = scene.field.frame.worldFromVoxel(voxel) + 0.5 * kVoxel * normal;
    double sum = 0;
    for (int n = 0; n < kRays; ++n) {
        const double angle = n * 2.399963229728653, square = (n + 0.5) / kRays;
        const glm::dvec3 across = std::cos(angle) * u + std::sin(angle) * v;
        const glm::dvec3 way = std::sqrt(square) * across + std::sqrt(1 - square) * normal;
        const PlainHit hit = castPlainVolume(scene.field, 0, {from, way, 0.0});
        if (!hit.hit()) sum += 1;
        if (hit.hit() && reach > 0) sum += 1 - std::exp(-hit.t / reach);
    }
    return sum / kRays;
}

TEST(SkySweep, ACornerIsDarkerThanTheOpenPlane) {
    const VolumeScene scene = skyScene(solidVolume(cubeFrame(64), floorAndBox));
    const SkyGrid grid = swept(scene);
    const auto floorAt = [&](double x) {
        return skySeenAt(grid, scene.field.frame, {x, 32, 12}, {0, 0, 1}).sky;
    };
    EXPECT_GT(floorAt(4), 0.9);
    EXPECT_LT(floorAt(22.5), 0.7);
    EXPECT_GT(floorAt(22.5), 0.5);
    for (int x = 5; x < 22; ++x) EXPECT_LE(floorAt(x), floorAt(x - 1) + 0.01) << x;
    EXPECT_GT(skySeenAt(grid, scene.field.frame, {32, 32, 28}, {0, 0, 1}).sky, 0.98) << "the box's top";
}

TEST(SkySweep, TheKeyLightCastsAShadow) {
    const VolumeScene scene = skyScene(solidVolume(cubeFrame(64), floorAndBox));
    SkySweepSetting setting;
    setting.keyFrom = glm::normalize(glm::dvec3(-1, 0, 1));
    const SkyGrid grid = swept(scene, setting);
    const auto keyAt = [&](double x) {
        return skySeenAt(grid, scene.field.frame, {x, 32, 12}, {0, 0, 1}).key;
    };
    EXPECT_GT(keyAt(20), 0.97);
    EXPECT_LT(keyAt(44), 0.05);
    EXPECT_GT(keyAt(62), 0.9) << "behind the shadow, 16 voxels long";
}

TEST(SkySweep, ABallHidesNothingFromItself) {
    const glm::dvec3 centre(23.5, 23.5, 23.5);
    const VolumeScene scene = skyScene(ballVolume(48, centre, 16));
    const SkyGrid grid = swept(scene);
    test::Random random(5);
    for (int n = 0; n < 2000; ++n) {
        const glm::dvec3 normal = glm::normalize(
            glm::dvec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) + 1e-9);
        ASSERT_GT(skySeenAt(grid, scene.field.frame, centre + 16.0 * normal, normal).sky, 0.95);
    }
}

TEST(SkySweep, NothingHidesNothingAndAFullBoxIsOpenAtItsFaces) {
    for (const double value : {-1.0, 1.0}) {
        const VolumeScene scene =
            skyScene(solidVolume(cubeFrame(9), [&](const glm::dvec3&) { return value; }));
        const SkyGrid grid = swept(scene);
        const SkySeen face = skySeenAt(grid, scene.field.frame, {4, 4, 8.5}, {0, 0, 1});
        EXPECT_GT(face.sky, 0.97) << value;
        EXPECT_GT(face.key, 0.97) << value;
        const double inside = skySeenAt(grid, scene.field.frame, {4, 4, 4}, {0, 0, 1}).sky;
        if (value < 0)
            EXPECT_NEAR(inside, 1, 1e-3);
        else
            EXPECT_LT(inside, 0.05);
        const SkySeen away = skySeenAt(grid, scene.field.frame, {1e6, -1e6, 4}, {0, 0, 0});
        EXPECT_TRUE(std::isfinite(away.sky) && std::isfinite(away.key));
    }
}

TEST(SkySweep, OneVoxelAndASlabOfTwo) {
    const VolumeScene one = skyScene(
        solidVolume(cubeFrame(9), [](const glm::dvec3& v) { return v == glm::dvec3(4) ? 1.0 : -1.0; }));
    const SkySeen seen = skySeenAt(swept(one), one.field.frame, {4, 4, 4.5}, {0, 0, 1});
    EXPECT_GT(seen.sky, 0.95);
    VolumeFrame frame = cubeFrame(2);
    const VolumeScene least = skyScene(solidVolume(frame, [](const glm::dvec3& v) { return v.x - 0.5; }));
    const SkySeen side = skySeenAt(swept(least), frame, {0.5, 0.5, 0.5}, {-1, 0, 0});
    EXPECT_GT(side.sky, 0.9);
    frame.size.z = 1;
    const VolumeScene flat = skyScene(solidVolume(frame, [](const glm::dvec3&) { return 1.0; }));
    EXPECT_THROW(swept(flat), Error);
}

// A slope in long voxels of a turned grid, which cells of about a cube's shape and few of them have to show.
TEST(SkySweep, ASlantedPlaneInLongVoxelsIsOpen) {
    VolumeFrame frame = test::slantedFrame({60, 60, 20}, {0.7e-3, 0.9e-3, 3e-3});
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.4, -0.3, 0.8));
    const glm::dvec3 middle = frame.worldFromVoxel(0.5 * glm::dvec3(frame.size - 1));
    const VolumeScene scene = skyScene(solidVolume(frame, [&](const glm::dvec3& v) {
        return -glm::dot(frame.worldFromVoxel(v) - middle, normal) / kVoxel;
    }));
    for (const std::size_t most : {std::size_t{1'000'000}, std::size_t{9'000}}) {
        SkySweepSetting setting;
        setting.mostCells = most;
        const SkyGrid grid = swept(scene, setting);
        EXPECT_LE(grid.count(), most);
        EXPECT_GT(skySeenAt(grid, frame, frame.voxelFromWorld(middle), normal).sky, 0.95) << most;
    }
}

// 300 places on the box and its floor and on a landscape of bumps.
TEST(SkySweep, IsNearToRays) {
    const auto bumps = [](const glm::dvec3& v) {
        return 20 + 7 * std::sin(v.x / 5) * std::cos(v.y / 7) - v.z;
    };
    for (const double reach : {0.0, 12 * kVoxel})
        for (const bool boxes : {true, false}) {
            const VolumeScene scene =
                skyScene(boxes ? solidVolume(cubeFrame(64), floorAndBox) : solidVolume(cubeFrame(64), bumps));
            SkySweepSetting setting;
            setting.reach = reach;
            const SkyGrid grid = swept(scene, setting);
            test::Random random(7);
            double square = 0;
            int count = 0;
            while (count < 300) {
                const double x = random.between(12, 52), y = random.between(12, 52);
                const PlainHit hit = castPlainVolume(
                    scene.field, 0, {scene.field.frame.worldFromVoxel({x, y, 60}), {0, 0, -1}, 0.0});
                if (!hit.hit()) continue;
                const glm::dvec3 normal = plainNormal(scene.field, hit.voxel());
                const double off = skySeenAt(grid, scene.field.frame, hit.voxel(), normal).sky -
                                   skyByRays(scene, hit.voxel(), normal, reach);
                square += off * off;
                ++count;
            }
            const double error = std::sqrt(square / count);
            RecordProperty(std::string(boxes ? "box" : "bumps") + (reach > 0 ? "_near" : ""),
                           std::to_string(error));
            EXPECT_LT(error, 0.07) << (boxes ? "box, reach " : "bumps, reach ") << reach;
        }
}

TEST(SkySweep, WhatLightPassesHidesLess) {
    VolumeScene scene = skyScene(solidVolume(cubeFrame(64), floorAndBox));
    const double step = test::kSteps;
    double last = 0;
    for (const double opacity : {1.0, 0.1, 0.01}) {
        scene.look.transfer =
            TransferFunction({{-1, glm::vec3(1), 0}, {1 / step, glm::vec3(1), opacity}}, 0.001, "test");
        const double sky = skySeenAt(swept(scene), scene.field.frame, {22, 32, 12}, {0, 0, 1}).sky;
        EXPECT_GT(sky, last + 0.05) << opacity;
        last = sky;
    }
    auto none = std::make_shared<Volume<std::uint8_t>>(scene.field.frame);
    scene.look.modulation = none;
    EXPECT_NEAR(skySeenAt(swept(scene), scene.field.frame, {22, 32, 12}, {0, 0, 1}).sky, 1, 1e-3);
}

TEST(SkySweep, TheThreadCountChangesNothing) {
    const VolumeScene scene = skyScene(solidVolume(cubeFrame(40), floorAndBox));
    const int before = threadCount();
    std::vector<SkyGrid> grids;
    for (const int threads : {1, 3}) {
        setThreadCount(threads);
        grids.push_back(swept(scene));
    }
    setThreadCount(before);
    ASSERT_EQ(grids[0].words.size(), grids[1].words.size());
    EXPECT_EQ(std::memcmp(grids[0].words.data(), grids[1].words.data(), 4 * grids[0].words.size()), 0);
}

TEST(SkySweep, TellsItsProgress) {
    const VolumeScene scene = skyScene(ballVolume(24, glm::dvec3(12), 8));
    test::expectWholeProgress("sky sweep", 3, [&](Progress& progress) { sweepSky(scene, {}, progress); });
}

}  // namespace
}  // namespace stereonav
