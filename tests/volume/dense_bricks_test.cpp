// Bricks that keep normals of corners against bricks that keep records of cells: the same of every cell, the
// same pictures bit for bit, less memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "engine/camera/stereo_rig.h"
#include "engine/render/eye_renderer.h"
#include "engine/volume/surface_cells.h"
#include "engine/volume/volume_renderer.h"
#include "test_volumes.h"

namespace stereonav {
namespace {

constexpr std::uint32_t kAllDense = 1, kSomeDense = SurfaceSetting::kDenseFrom,
                        kNoneDense = SurfaceSetting::kNeverDense;

// Noise in one half, a plane's smooth values in the other; rays from outside start in values below all of it.
GreyVolume halfNoise() {
    VolumeFrame frame;
    frame.size = {66, 41, 50};
    frame.spacing = {0.9e-3, 1.1e-3, 1e-3};
    frame.origin = {-0.03, -0.02, -0.025};
    test::Random random(5);
    GreyVolume volume(frame);
    const glm::ivec3 last = frame.size - 1;
    for (int k = 0; k <= last.z; ++k)
        for (int j = 0; j <= last.y; ++j)
            for (int i = 0; i <= last.x; ++i) {
                const bool face = i == 0 || j == 0 || k == 0 || i == last.x || j == last.y || k == last.z;
                const double value = i < 33 ? random.between(-900, 900) : 40.0 * (j - 20.3) + 3 * k;
                volume.at(i, j, k) = static_cast<std::int16_t>(face ? -1000 : std::lround(value));
            }
    return volume;
}

SurfaceCells halfNoiseCells(const GreyVolume& volume, std::uint32_t denseFrom, bool translucent,
                            std::size_t atOnce = SurfaceSetting::kCellsAtOnce) {
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = 30;
    if (translucent) {
        setting.lowest = -200;
        setting.highest = 32767;
    }
    setting.denseFrom = denseFrom;
    setting.atOnce = atOnce;
    Progress progress;
    return findSurfaceCells(volume, setting, progress);
}

void expectSameRecords(const SurfaceCells& dense, const SurfaceCells& kept) {
    ASSERT_EQ(dense.active, kept.active);
    ASSERT_EQ(kept.active, kept.records.size());
    std::size_t active = 0;
    const glm::ivec3 cells = kept.frame.size - 1;
    for (int k = 0; k < cells.z; ++k)
        for (int j = 0; j < cells.y; ++j)
            for (int i = 0; i < cells.x; ++i) {
                const std::optional<CellRecord> a = dense.record({i, j, k}), b = kept.record({i, j, k});
                ASSERT_EQ(a.has_value(), b.has_value()) << i << " " << j << " " << k;
                if (!a) continue;
                ++active;
                ASSERT_EQ(std::memcmp(a->values, b->values, sizeof a->values), 0)
                    << i << " " << j << " " << k;
                ASSERT_EQ(std::memcmp(a->normals, b->normals, sizeof a->normals), 0)
                    << i << " " << j << " " << k;
            }
    EXPECT_EQ(active, kept.active);
}

TEST(DenseBricks, KeepWhatRecordsKeep) {
    const GreyVolume volume = halfNoise();
    for (const bool translucent : {false, true}) {
        const SurfaceCells kept = halfNoiseCells(volume, kNoneDense, translucent);
        EXPECT_TRUE(kept.normals.empty());
        const SurfaceCells all = halfNoiseCells(volume, kAllDense, translucent);
        EXPECT_TRUE(all.records.empty());
        expectSameRecords(all, kept);
        const SurfaceCells some = halfNoiseCells(volume, kSomeDense, translucent);
        EXPECT_FALSE(some.records.empty());
        EXPECT_FALSE(some.normals.empty());
        expectSameRecords(some, kept);
        expectSameRecords(halfNoiseCells(volume, kSomeDense, translucent, 0), kept);
    }
}

TEST(DenseBricks, TakeLessMemory) {
    const GreyVolume volume = halfNoise();
    const auto bytesOf = [&](std::uint32_t denseFrom) {
        const SurfaceCells cells = halfNoiseCells(volume, denseFrom, true);
        return cells.records.size() * sizeof(CellRecord) + cells.normals.size() * sizeof(std::uint32_t);
    };
    EXPECT_LT(3 * bytesOf(kSomeDense), bytesOf(kNoneDense));
}

TEST(DenseBricks, AreNeverMadeOfARegion) {
    const GreyVolume volume = halfNoise();
    MaskVolume region(volume.frame);
    std::fill_n(region.values.data(), volume.frame.count() / 2, std::uint8_t{1});
    SurfaceSetting setting{30, 30, 30, &region};
    setting.denseFrom = kAllDense;
    Progress progress;
    const SurfaceCells cells = findSurfaceCells(volume, setting, progress);
    EXPECT_TRUE(cells.normals.empty());
    EXPECT_GT(cells.active, 1000u);
}

EyeImage pictureOf(const VolumeScene& scene, const EyeView& view, SimdTarget target) {
    VolumeCasting casting;
    casting.target = target;
    const VolumeRenderer renderer(scene, casting);
    EyeImage picture;
    picture.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, picture);
    return picture;
}

// Packets whose rays meet dense bricks, others, and both.
TEST(DenseBricks, ShowTheSamePicture) {
    VolumeScene scene;
    scene.field = halfNoise();
    Lens lens;
    lens.width = 96;
    lens.height = 64;
    lens.nearDepth = 0.001;
    const EyeView view =
        makeStereoViews(poseFromAngles({0.005, -0.09, 0.01}, 0, -0.05, 0), lens, {0.004, 0.1}).left;
    for (const bool translucent : {false, true})
        for (const SimdTarget target : simdTargets()) {
            if (translucent)
                scene.look.transfer = TransferFunction(
                    {{-200, glm::vec3(1, 0.5f, 0.2f), 0.0}, {300, glm::vec3(0.3f, 1, 0.8f), 0.4}}, 0.001, "");
            scene.cells = halfNoiseCells(scene.field, kNoneDense, translucent);
            const EyeImage kept = pictureOf(scene, view, target);
            for (const std::uint32_t denseFrom : {kAllDense, kSomeDense}) {
                scene.cells = halfNoiseCells(scene.field, denseFrom, translucent);
                const EyeImage dense = pictureOf(scene, view, target);
                int hits = 0;
                for (int y = 0; y < view.height; ++y)
                    for (int x = 0; x < view.width; ++x) {
                        ASSERT_EQ(dense.color.at(x, y), kept.color.at(x, y)) << x << " " << y;
                        ASSERT_EQ(dense.viewDepth.at(x, y), kept.viewDepth.at(x, y)) << x << " " << y;
                        hits += std::isfinite(kept.viewDepth.at(x, y));
                    }
                EXPECT_GT(hits, 1000);
            }
            scene.look.transfer = {};
        }
}

}  // namespace
}  // namespace stereonav
