// What is chosen for a volume seen from outside: its surface by the kinds of its values, which way is up,
// where it is seen from, and presets fitted to it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "colon/scene/guessed_up.h"
#include "colon/scene/isosurface_scene.h"
#include "colon/scene/transfer_presets.h"
#include "engine/volume/seen_blocks.h"

namespace stereonav {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// counted: values and how many voxels have them.
ValueCounts countsOf(const std::vector<std::pair<int, std::uint64_t>>& counted, double scale = 1,
                     double offset = 0) {
    ValueCounts counts;
    counts.counts.resize(65536);
    counts.scale = scale;
    counts.offset = offset;
    for (const auto& [stored, voxels] : counted)
        counts.counts[static_cast<std::size_t>(stored + 32768)] += voxels;
    return counts;
}
VolumeFrame millimetres() {
    VolumeFrame frame;
    frame.spacing = glm::dvec3(0.001);
    return frame;
}
IsovalueChoice chosen(const ValueCounts& counts, bool hounsfield) {
    return isovalueFor(counts, kindsOf(counts, hounsfield, millimetres()));
}

GreyVolume volumeOf(const glm::ivec3& size, const std::function<double(const glm::dvec3&)>& valueAt) {
    VolumeFrame frame = millimetres();
    frame.size = size;
    GreyVolume grey(frame);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                grey.at(i, j, k) = static_cast<std::int16_t>(valueAt(glm::dvec3(i, j, k)));
    return grey;
}

ColonOptions looked() {
    ColonOptions options;
    options.chosen.values = options.chosen.view = true;
    return options;
}
ColonScene sceneOf(const GreyVolume& grey, const ColonOptions& options, bool directed = true) {
    Progress progress;
    return isosurfaceScene(grey.share(), options, progress, {directed});
}

TEST(ChosenIsovalue, IsBoneFrom200To300AndElseSkin) {
    const std::pair<int, std::uint64_t> air{-1000, 50000}, flesh{40, 50000}, bone{800, 1000};
    EXPECT_EQ(chosen(countsOf({air, flesh, bone}), true).isovalue, 200);
    EXPECT_EQ(chosen(countsOf({air, flesh, bone, {230, 1500}}), true).isovalue, 200) << "rims of bones";
    EXPECT_EQ(chosen(countsOf({air, flesh, bone, {230, 5000}}), true).isovalue, 250) << "contrast";
    EXPECT_EQ(chosen(countsOf({air, flesh, bone, {270, 5000}}), true).isovalue, 300);
    EXPECT_EQ(chosen(countsOf({air, flesh}), true).isovalue, -300);
    EXPECT_EQ(chosen(countsOf({air, flesh, {800, 100}}), true).isovalue, -300)
        << "a calcification is no bone";
    // Air alone has no skin.
    const double noise = chosen(countsOf({{-1000, 100}, {-900, 10}}), true).isovalue;
    EXPECT_GT(noise, -1000);
    EXPECT_LT(noise, -900);
}

TEST(ChosenIsovalue, LeavesWhatIsThin) {
    // Few voxels of leaves near the background, wood, and a heavy pot: Otsu's two classes would cut at the
    // wood.
    const ValueCounts plant = countsOf({{0, 900000},
                                        {5, 9000},
                                        {10, 4000},
                                        {40, 4000},
                                        {42, 4000},
                                        {120, 30000},
                                        {130, 30000},
                                        {200, 6000}});
    const double value = chosen(plant, false).isovalue;
    EXPECT_GT(value, 10);
    EXPECT_LT(value, 40);
}

// The flank of one peak has no valley: its emptiest place is as far out as it may be looked for.
TEST(ChosenIsovalue, ValleyHasTwoSides) {
    std::vector<std::pair<int, std::uint64_t>> flank;
    for (int value = 0; value < 256; ++value)
        flank.emplace_back(value, static_cast<std::uint64_t>(1e6 * std::exp(-value / 30.0)) + 1);
    const double border = chosen(countsOf(flank), false).isovalue;
    // Otsu's upper border of three classes is at 77.
    EXPECT_GT(border, 65);
    EXPECT_LT(border, 90);
    // With an object beyond, the valley is before it.
    for (int value = 70; value < 90; ++value) flank.emplace_back(value, 400000);
    const double valley = chosen(countsOf(flank), false).isovalue;
    EXPECT_GT(valley, 60);
    EXPECT_LT(valley, 71);
}

TEST(ChosenIsovalue, OfFewValues) {
    EXPECT_EQ(chosen(countsOf({{0, 1000}, {100, 10}}), false).isovalue, 50) << "half way, of a mask";
    EXPECT_EQ(chosen(countsOf({{7, 1000}}), false).isovalue, 7);
    EXPECT_EQ(chosen(countsOf({{-32768, 1}, {32767, 1}}), false).isovalue, -0.5);
    const double three = chosen(countsOf({{0, 10}, {10, 10}, {20, 10}}), false).isovalue;
    EXPECT_EQ(three, 5);
    // The same in other units, and with numbers that fall as values rise.
    EXPECT_NEAR(chosen(countsOf({{0, 10}, {10, 10}, {20, 10}}, 0.001, 3), false).isovalue, 3.005, 1e-12);
    EXPECT_NEAR(chosen(countsOf({{0, 10}, {10, 10}, {20, 10}}, -2, 0), false).isovalue, -30, 1e-12);
    EXPECT_TRUE(std::isfinite(chosen(countsOf({{0, 10}, {10, 10}, {20, 10}}, 1e300, 0), false).isovalue));
}

TEST(ChosenIsovalue, OneBrightVoxelMovesNothing) {
    std::vector<std::pair<int, std::uint64_t>> counted;
    for (int value = 0; value < 10; ++value) counted.emplace_back(value, 10000);
    for (int value = 100; value < 120; ++value) counted.emplace_back(value, 1000);
    const double value = chosen(countsOf(counted), false).isovalue;
    counted.emplace_back(32000, 1);
    EXPECT_NEAR(chosen(countsOf(counted), false).isovalue, value, 1);
    EXPECT_GT(value, 9);
    EXPECT_LT(value, 100);
}

TEST(ChosenKinds, CtWithNumbersFromAirOnIsKnown) {
    const ValueCounts ct = countsOf(
        {{0, 50000}, {24, 50000}, {924, 5000}, {1064, 30000}, {1070, 20000}, {1500, 5000}, {2500, 2000}});
    EXPECT_TRUE(kindsOf(ct, false, millimetres()).shifted);
    EXPECT_FALSE(kindsOf(countsOf({{0, 50000}, {300, 9000}, {2000, 9000}}), false, millimetres()).shifted);
    EXPECT_FALSE(kindsOf(countsOf({{0, 50000}, {100, 9000}, {255, 9000}}), false, millimetres()).shifted);
}

// A head: a skull around a brain, a neck below it; upwards or with its numbers from air on, as files have it.
GreyVolume headOf(bool standsOnItsHead) {
    return volumeOf({48, 48, 60}, [&](const glm::dvec3& voxel) {
        const double z = standsOnItsHead ? 59 - voxel.z : voxel.z;
        const double across = glm::length(glm::dvec2(voxel) - glm::dvec2(24));
        const double skull = glm::length(glm::dvec3(voxel.x, voxel.y, z) - glm::dvec3(24, 24, 38));
        if (skull < 17) return 1060;
        if (skull < 20) return 2000;
        if (skull < 21 || (z < 25 && across < 15)) return 1060;
        return 20;
    });
}

TEST(ChosenUp, IsWhereTheSkullIs) {
    for (const bool overturned : {false, true}) {
        const GreyVolume head = headOf(overturned);
        const ColonScene scene = sceneOf(head, looked(), false);
        ASSERT_TRUE(scene.kinds.shifted);
        EXPECT_EQ(scene.up.has_value(), overturned);
        EXPECT_EQ(scene.up.value_or(UpAxis()), (UpAxis{2, overturned}));
        EXPECT_THAT(scene.notes, Contains(HasSubstr("--up gives another")));
        // What a file says, an option asks for or nobody looks at is left.
        EXPECT_FALSE(sceneOf(head, looked(), true).up);
        ColonOptions plain = looked();
        plain.chosen = {};
        EXPECT_FALSE(sceneOf(head, plain, false).up);
        ColonOptions asked = looked();
        asked.up = UpAxis{1, false};
        EXPECT_FALSE(sceneOf(head, asked, false).up) << "turned by who calls";
        ColonOptions baked = looked();
        baked.chosen.baked = true;
        EXPECT_FALSE(sceneOf(head, baked, false).up);
    }
}

TEST(ChosenUp, IsAwayFromAFlatBase) {
    // A cone on a plate, along y.
    for (const bool back : {false, true}) {
        const GreyVolume cone = volumeOf({50, 50, 50}, [&](const glm::dvec3& voxel) {
            const double y = back ? 49 - voxel.y : voxel.y;
            const double across = glm::length(glm::dvec2(voxel.x, voxel.z) - glm::dvec2(25));
            return y > 3 && y < 45 && across < 20 * (45 - y) / 42 ? 200.0 : 0.0;
        });
        const GuessedUp guess = guessUp(cone, {}, 100);
        ASSERT_TRUE(guess.up);
        EXPECT_EQ(*guess.up, (UpAxis{1, back}));
    }
    const GreyVolume ball = volumeOf(
        {40, 40, 40}, [](const glm::dvec3& voxel) { return glm::length(voxel - 20.0) < 15 ? 200.0 : 0.0; });
    EXPECT_FALSE(guessUp(ball, {}, 100).up) << "nothing speaks against z";
    EXPECT_FALSE(guessUp(ball, {}, 300).up) << "nothing is seen";
    EXPECT_FALSE(guessUp(GreyVolume(), {}, 100).up);
}

// The longer side of what a volume's voxels from `stored` on take of a picture's height.
double filled(const ColonScene& scene, double stored) {
    const GreyVolume& field = scene.volume.field;
    glm::dvec2 low(1e9), high(-1e9);
    for (int k = 0; k < field.frame.size.z; ++k)
        for (int j = 0; j < field.frame.size.y; ++j)
            for (int i = 0; i < field.frame.size.x; ++i) {
                if (field.at(i, j, k) < stored) continue;
                const glm::dvec3 away =
                    field.frame.worldFromVoxel(glm::dvec3(i, j, k)) - scene.startPose.position;
                const double half =
                    glm::dot(away, scene.startPose.forward()) * std::tan(0.5 * scene.lens.verticalFov);
                const glm::dvec2 at(glm::dot(away, scene.startPose.right()) / half,
                                    glm::dot(away, scene.startPose.up()) / half);
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
    return 0.5 * std::max(high.x - low.x, high.y - low.y);
}

TEST(ChosenView, IsFilledByWhatIsSeen) {
    // A small long piece in the corner of a large box, around it a veil.
    const GreyVolume grey = volumeOf({90, 70, 60}, [](const glm::dvec3& voxel) {
        const bool piece =
            voxel.x > 60 && voxel.x < 70 && voxel.y > 10 && voxel.y < 20 && voxel.z > 5 && voxel.z < 45;
        return piece ? 200.0 : glm::length(voxel - glm::dvec3(65, 30, 25)) < 24 ? 60.0 : 0.0;
    });
    ColonOptions options = looked();
    options.isovalue = 120;
    const double opaque = filled(sceneOf(grey, options), 120);
    EXPECT_GT(opaque, 0.7);
    EXPECT_LT(opaque, 0.85);
    // Through a function that shows the veil, the veil counts.
    options.transfer = "curve:50:1:1:1:0,60:1:1:1:0.5,200:1:1:1:1";
    const ColonScene veiled = sceneOf(grey, options);
    EXPECT_GT(filled(veiled, 60), 0.7);
    EXPECT_LT(filled(veiled, 60), 0.85);
    options.transfer.clear();
    options.chosen.aspect = 0.5;
    EXPECT_NEAR(filled(sceneOf(grey, options), 120) / 0.5, opaque, 0.03) << "in a narrow picture";
}

TEST(ChosenPresets, AreFittedToOtherValues) {
    const ValueCounts bytes = countsOf({{0, 900000}, {100, 50000}, {220, 50000}});
    const ValueKinds kinds = kindsOf(bytes, false, millimetres());
    const TransferFunction bone = fittedTransfer("bone", kinds), skin = fittedTransfer("skin", kinds);
    EXPECT_EQ(bone.at(100).opacity, 0) << "soft";
    EXPECT_GT(bone.at(220).opacity, 0.8) << "dense";
    EXPECT_GT(skin.at(100).opacity, 0.8);
    EXPECT_EQ(skin.at(0).opacity, 0);
    EXPECT_EQ(fittedTransfer("metal", kinds).points(), findTransferFunction("metal").points()) << "of 8 bits";
    ValueKinds wide = kinds;
    wide.highest = 65535;
    EXPECT_NEAR(fittedTransfer("metal", wide).points()[4].value, 220.0 / 255 * 65535, 1e-6);
    // In HU they are as they are written, and metal is an implant's.
    ValueKinds ct;
    ct.hounsfield = true;
    EXPECT_EQ(fittedTransfer("bone", ct), findTransferFunction("bone"));
    EXPECT_EQ(fittedTransfer("metal", ct).at(1800).opacity, 0);
    EXPECT_EQ(fittedTransfer("metal", ct).at(3000).opacity, 1);
    ct.hounsfield = false;
    ct.shifted = true;
    EXPECT_EQ(fittedTransfer("bone", ct).points()[0].value,
              findTransferFunction("bone").points()[0].value + 1024);
    // Voxels of a micrometre are as opaque as those of a millimetre.
    ValueKinds micro = kinds;
    micro.spacing = 1e-6;
    EXPECT_NEAR(fittedTransfer("bone", micro).referenceLength(), 1e-6, 1e-15);
    EXPECT_THROW(fittedTransfer("bones", kinds), std::exception);
}

TEST(ChosenPresets, OfDegenerateKindsStaySound) {
    for (const double highest : {0.0, 1e-300, 1e300}) {
        ValueKinds kinds;
        kinds.highest = highest;
        for (const TransferPreset& preset : transferPresets())
            EXPECT_GE(fittedTransfer(preset.name, kinds).points().size(), 1u) << preset.name << highest;
    }
}

TEST(ChosenPresets, WhatShowsNothingIsSaid) {
    const GreyVolume body = volumeOf({40, 40, 40}, [](const glm::dvec3& voxel) {
        return glm::length(voxel - 20.0) < 15 ? 40.0 : -1000.0;
    });
    ColonOptions options = looked();
    options.transfer = "metal";
    const ColonScene dark = sceneOf(body, options);
    EXPECT_THAT(dark.warning, HasSubstr("metal shows nothing here"));
    EXPECT_THAT(dark.warning, HasSubstr("HU from -1000 to 40"));
    EXPECT_THAT(dark.warning, HasSubstr("soft_tissue"));
    EXPECT_THAT(dark.warning, Not(HasSubstr("bone,")));
    EXPECT_THAT(dark.notes, Contains(dark.warning));
    EXPECT_THAT(emptyPresets(*dark.counts, dark.kinds), testing::IsSupersetOf({"metal", "bone"}));
    options.transfer = "soft_tissue";
    EXPECT_EQ(sceneOf(body, options).warning, "");
    options.transfer = "curve:5000:1:1:1:0,6000:1:1:1:1";
    EXPECT_THAT(sceneOf(body, options).warning, HasSubstr("this curve shows nothing"));
    // Changed in the window.
    options.transfer = "metal";
    Progress progress;
    EXPECT_THAT(changedScene(sceneOf(body, looked()), options, progress).warning, HasSubstr("metal"));
    options.transfer.clear();
    EXPECT_EQ(changedScene(dark, options, progress).warning, "");
}

TEST(ChosenPresets, AMaskShowsSomethingOfNearlyAll) {
    const ValueCounts mask = countsOf({{0, 100000}, {100, 5000}});
    const ValueKinds kinds = kindsOf(mask, false, millimetres());
    const std::vector<std::string> empty = emptyPresets(mask, kinds);
    for (const char* const name : {"metal", "bone", "skin", "vessels", "soft_tissue"})
        EXPECT_THAT(empty, Not(Contains(name)));
}

}  // namespace
}  // namespace stereonav
