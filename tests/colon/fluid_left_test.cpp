// Tagged fluid that is left in a made scan: where its surface lies, how much air is above it, and what
// becomes of loops that it fills.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "colon/scene/colon_cache.h"
#include "colon/scene/saved_lumen.h"
#include "colon/segmentation/segmentation.h"
#include "tests/support/made_ct.h"

namespace stereonav::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double kBlur = 0.0007;       // metres
constexpr double kFluidFrom = 0.0585;  // between the voxels of TubeBody's air and fluid
constexpr double kAirHu = -1000, kFluidHu = 400;

LumenField lumenWithFluidLeft(const GreyVolume& scan, const std::vector<glm::dvec3>& seeds = {}) {
    SegmentationSetting setting;
    setting.leavesFluid = true;
    setting.seeds = seeds;
    Progress progress;
    return segmentColon(scan, setting, progress);
}

const GreyVolume& tubeScan() {
    static const GreyVolume scan =
        scanned(filled({120, 110, 120}, TubeBody::kSpacing, TubeBody::hu), kBlur, 20);
    return scan;
}

// Returns where a step from air to fluid, blurred by a Gaussian, has the wall's value: metres before the
// step.
double beforeTheStep(double wall) {
    const double share = (wall - kAirHu) / (kFluidHu - kAirHu);
    double low = -5, high = 0;  // bounds in the normal distribution: share is below a half
    for (int n = 0; n < 60; ++n) {
        const double middle = 0.5 * (low + high);
        (0.5 * std::erfc(-middle / std::sqrt(2.0)) < share ? low : high) = middle;
    }
    return -low * kBlur;
}

// Metres along y where the field first reaches the wall above x, z, from the middle of the air on.
double levelAt(const LumenField& lumen, double x, double z) {
    const VolumeFrame& frame = lumen.field.frame;
    const auto value = [&](double y) {
        const glm::ivec3 at(glm::round(frame.voxelFromWorld({x, y, z})));
        return static_cast<double>(lumen.field.at(at));
    };
    for (double y = 0.050; y < 0.066; y += 0.001) {
        const double before = value(y), after = value(y + 0.001);
        if (before < lumen.isovalue && after >= lumen.isovalue)
            return y + 0.001 * (lumen.isovalue - before) / (after - before);
    }
    return 0;
}

TEST(FluidLeft, HasAWallAtItsLevel) {
    const LumenField lumen = lumenWithFluidLeft(tubeScan());
    double sum = 0;
    int count = 0;
    for (double x = 0.054; x < 0.0665; x += 0.001)
        for (double z = 0.030; z < 0.080; z += 0.001) {
            const double level = levelAt(lumen, x, z);
            ASSERT_NEAR(level, kFluidFrom - beforeTheStep(lumen.isovalue), 0.0003) << x << ' ' << z;
            sum += level;
            ++count;
        }
    // The sum of noise over hundreds of columns is small against a voxel.
    EXPECT_NEAR(sum / count, kFluidFrom - beforeTheStep(lumen.isovalue), 0.00005);
}

TEST(FluidLeft, LeavesTheAirAboveItAlone) {
    const LumenField lumen = lumenWithFluidLeft(tubeScan());
    ASSERT_EQ(lumen.segments.size(), 1u);
    const double r = 0.012, depth = kFluidFrom - beforeTheStep(lumen.isovalue) - 0.055;
    const double area =
        r * r * (std::numbers::pi - std::acos(depth / r)) + depth * std::sqrt(r * r - depth * depth);
    EXPECT_NEAR(lumen.segments[0].volume / (area * 0.07), 1, 0.03);
    EXPECT_THAT(lumen.notes, Contains(HasSubstr("left 1 pool(s) of tagged fluid in")));
    Progress progress;
    const LumenField out = segmentColon(tubeScan(), {}, progress);
    const double all = std::numbers::pi * r * r;
    EXPECT_NEAR(out.segments[0].volume / lumen.segments[0].volume / (all / area), 1, 0.05);
}

// A tube that dips below the level in its middle. Its air is in two pieces, of which one is named.
int dipping(glm::dvec3 p) {
    const glm::dvec2 skin((p.x - 0.06) / 0.055, (p.y - 0.055) / 0.05);
    if (glm::dot(skin, skin) > 1) return -1000;
    const double dip = (p.z - 0.06) / 0.012, middle = 0.050 + 0.022 * std::exp(-dip * dip);
    const bool inside = std::hypot(p.x - 0.06, p.y - middle) < 0.010 && p.z > 0.015 && p.z < 0.105;
    return inside ? (p.y > 0.055 ? 400 : -1000) : 40;
}

TEST(FluidLeft, CutsALoopThatItFills) {
    const GreyVolume scan = scanned(filled({120, 110, 120}, 0.001, dipping), kBlur, 20);
    const std::vector<glm::dvec3> seeds = {{0.06, 0.047, 0.03}};
    const LumenField left = lumenWithFluidLeft(scan, seeds);
    ASSERT_EQ(left.segments.size(), 2u) << "the fluid ties the other piece of air to the colon";
    EXPECT_NEAR(left.segments[0].volume / left.segments[1].volume, 1, 0.05);
    EXPECT_THAT(left.notes, Contains(HasSubstr("2 piece(s)")));
    SegmentationSetting setting;
    setting.seeds = seeds;
    Progress progress;
    EXPECT_EQ(segmentColon(scan, setting, progress).segments.size(), 1u);
}

TEST(FluidLeft, IsReadBackAsItWasFound) {
    LumenField found = lumenWithFluidLeft(tubeScan());
    SegmentationSetting setting;
    setting.leavesFluid = true;
    const auto restored = restoreLumen(tubeScan(), found.lumen.share(), setting);
    ASSERT_TRUE(restored);
    EXPECT_EQ(restored->segments.size(), found.segments.size());
    const glm::ivec3 size = found.lumen.frame.size;
    int wrong = 0;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                wrong += (restored->field.at(i, j, k) < setting.wall) !=
                             (found.field.at(i, j, k) < setting.wall) &&
                         found.lumen.at(i, j, k) != 0;
    EXPECT_EQ(wrong, 0);
}

TEST(FluidLeft, IsKeptUnderAKeyOfItsOwn) {
    ColonOptions out, left;
    left.segmentation.leavesFluid = true;
    EXPECT_NE(colonCacheKey(1, out), colonCacheKey(1, left));
    EXPECT_NE(savedLumenKey(1, out.segmentation), savedLumenKey(1, left.segmentation));
}

}  // namespace
}  // namespace stereonav::test
