// The colon from grey values: made scans whose lumen is known, and one clear line for what can not be.
#include "colon/segmentation/segmentation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "colon/segmentation/lumen_pieces.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "tests/support/made_ct.h"

namespace stereonav {
namespace {

using test::filled;
using test::TubeBody;
using testing::HasSubstr;

LumenField segment(const GreyVolume& study, const std::vector<glm::dvec3>& seeds = {}) {
    SegmentationSetting setting;
    setting.seeds = seeds;
    Progress progress;
    return segmentColon(study, setting, progress);
}

std::string segmentationErrorOf(const GreyVolume& study, const std::vector<glm::dvec3>& seeds = {}) {
    try {
        segment(study, seeds);
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

struct PartOverlap {
    std::size_t truth = 0, found = 0, both = 0;
    double dice() const { return 2.0 * static_cast<double>(both) / static_cast<double>(truth + found); }
};

// inColon and counted: by voxel of the study.
PartOverlap overlap(const LumenField& lumen, const VolumeFrame& study,
                    const std::function<bool(glm::ivec3)>& inColon,
                    const std::function<bool(glm::ivec3)>& counted) {
    PartOverlap sum;
    const glm::ivec3 first(
        glm::floor(study.voxelFromWorld(lumen.lumen.frame.worldFromVoxel(glm::dvec3(0))) + 0.5));
    for (int k = 0; k < study.size.z; ++k)
        for (int j = 0; j < study.size.y; ++j)
            for (int i = 0; i < study.size.x; ++i) {
                const glm::ivec3 at = glm::ivec3(i, j, k) - first;
                const bool found = lumen.lumen.frame.contains(at) && lumen.lumen.at(at) != 0;
                const bool truth = inColon({i, j, k});
                if ((!found && !truth) || !counted({i, j, k})) continue;
                sum.found += found;
                sum.truth += truth;
                sum.both += found && truth;
            }
    return sum;
}

// Every voxel of the lumen is below the isovalue, and no neighbour of it outside is.
void expectContract(const LumenField& lumen) {
    const VolumeFrame& frame = lumen.lumen.frame;
    std::size_t wrong = 0, voxels = 0;
    const glm::ivec3 steps[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                if (!lumen.lumen.at(i, j, k)) continue;
                ++voxels;
                wrong += !(lumen.field.at(i, j, k) < lumen.isovalue);
                for (const glm::ivec3& step : steps) {
                    const glm::ivec3 to = glm::ivec3(i, j, k) + step;
                    wrong +=
                        !frame.contains(to) || (!lumen.lumen.at(to) && lumen.field.at(to) < lumen.isovalue);
                }
            }
    EXPECT_GT(voxels, 0u);
    EXPECT_EQ(wrong, 0u);
}

TEST(SegmentColon, TaggedFluidBelongsToTheLumenAndBoneDoesNot) {
    const GreyVolume study = test::scanned(filled({120, 110, 120}, 0.001, TubeBody::hu), 0.0007, 20);
    const LumenField lumen = segment(study);
    expectContract(lumen);
    ASSERT_EQ(lumen.segments.size(), 1u);
    const auto truth = [](glm::ivec3 v) { return TubeBody::tube(glm::dvec3(v) * 0.001) < 0; };
    const auto all = overlap(lumen, study.frame, truth, [](glm::ivec3) { return true; });
    const auto fluid = overlap(lumen, study.frame, truth, [](glm::ivec3 v) { return v.y > 58; });
    const auto film = overlap(lumen, study.frame, truth, [](glm::ivec3 v) { return v.y > 54 && v.y < 62; });
    std::printf("Dice %.4f, in fluid %.4f, at the film %.4f\n", all.dice(), fluid.dice(), film.dice());
    EXPECT_GE(all.dice(), 0.98);
    EXPECT_GE(fluid.dice(), 0.98);
    EXPECT_GE(film.dice(), 0.98);
}

TEST(SegmentColon, SeedsChooseThePieces) {
    const GreyVolume study = test::scanned(filled({120, 110, 120}, 0.001, TubeBody::hu), 0.0007, 20);
    EXPECT_EQ(segmentationErrorOf(study, {{0.06, 0.050, 0.05}}), "no error");
    EXPECT_THAT(segmentationErrorOf(study, {{0.03, 0.055, 0.05}}),
                HasSubstr("--seed 30,55,50: lies in tissue"));
    EXPECT_THAT(segmentationErrorOf(study, {{0.03, 0.055, 5}}), HasSubstr("outside the volume"));
    EXPECT_THAT(segmentationErrorOf(study, {{0.03, std::numeric_limits<double>::quiet_NaN(), 0}}),
                HasSubstr("finite"));
}

TEST(SegmentColon, TwoPiecesAreTwoSegments) {
    const GreyVolume truth = filled({120, 110, 120}, 0.001, [](glm::dvec3 p) {
        const int hu = TubeBody::hu(p);
        return TubeBody::tube(p) < 0 ? (std::abs(p.z - 0.055) < 0.004 ? 40 : -1000) : hu;
    });
    SegmentationSetting setting;
    setting.seeds = {{0.06, 0.055, 0.03}, {0.06, 0.055, 0.08}};
    Progress progress;
    const LumenField lumen = segmentColon(test::scanned(truth, 0.0007, 20), setting, progress);
    expectContract(lumen);
    ASSERT_EQ(lumen.segments.size(), 2u);
    EXPECT_LT(lumen.segments[0].last.z, lumen.segments[1].first.z);
}

TEST(SegmentColon, WhatHoldsNoColonIsRefused) {
    const glm::ivec3 size(30, 30, 30);
    EXPECT_THAT(segmentationErrorOf(filled(size, 0.001, [](glm::dvec3) { return -1000; })),
                HasSubstr("nothing but air"));
    EXPECT_THAT(segmentationErrorOf(filled(size, 0.001, [](glm::dvec3) { return 40; })), HasSubstr("no air"));
    EXPECT_THAT(
        segmentationErrorOf(filled(size, 0.001, [](glm::dvec3 p) { return p.x < 0.01 ? -1000 : 40; })),
        HasSubstr("nothing like a colon"));
    EXPECT_THAT(segmentationErrorOf(filled({1, 1, 1}, 0.001, [](glm::dvec3) { return 40; })),
                HasSubstr("no air"));
    EXPECT_THAT(
        segmentationErrorOf(filled({2, 1, 1}, 0.001, [](glm::dvec3 p) { return p.x > 0 ? -1000 : 40; })),
        HasSubstr("nothing like a colon"));
}

std::filesystem::path realMask() {
    const char* given = std::getenv("STEREONAV_TEST_DATA");
    const std::filesystem::path data = given ? given : STEREONAV_SOURCE_DIR "/../shared/data";
    return data / "colon/gca00020/large_intestine_mask_clean.nrrd";
}

constexpr int kPad = 40, kPadTop = 130;  // voxels; lungs lie in the upper one

MaskVolume readRealMask() {
    VolumeFrame frame;
    frame.size = {411, 332, 635};
    frame.spacing = {0.000808594, 0.000808594, 0.0007};
    MaskVolume mask(frame);
    const std::string command = "sed '1,/^$/d' '" + realMask().string() + "' | gzip -dc";
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return {};
    const std::size_t count = std::fread(mask.values.data(), 1, mask.values.size(), pipe);
    return pclose(pipe) == 0 && count == mask.values.size() ? std::move(mask) : MaskVolume();
}

constexpr int kLevel = 200;  // row of the mask: fluid lies behind

// Returns the parts of the lumen that lie behind the level; the largest of them is filled.
Pieces lowParts(const MaskVolume& mask) {
    Pieces low;
    const VoxelRuns all = runsOf(mask);
    low.runs = collectRuns(mask.frame.size, [&](int j, int k, std::vector<VoxelRun>& runs) {
        if (j > kLevel) runs.insert(runs.end(), all.row(j, k).begin(), all.row(j, k).end());
    });
    low.parts = connectedComponents(low.runs);
    return low;
}

std::uint32_t largestOf(const Pieces& pieces) {
    const auto& list = pieces.parts.list;
    const auto less = [](const Component& a, const Component& b) { return a.voxels < b.voxels; };
    return static_cast<std::uint32_t>(std::max_element(list.begin(), list.end(), less) - list.begin());
}

// A body around the real lumen: fluid, bones, lungs with vessels.
GreyVolume realScan(const MaskVolume& mask, const Pieces& low, std::uint32_t pool) {
    VolumeFrame frame = mask.frame;
    frame.size += glm::ivec3(2 * kPad, 2 * kPad, kPadTop);
    GreyVolume truth(frame);
    const glm::dvec3 size(frame.size);
    parallelFor(frame.size.z, [&](int k) {
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                const glm::dvec2 d((i / size.x - 0.5) * 2.02, (j / size.y - 0.5) * 2.02);
                const glm::ivec3 at(i - kPad, j - kPad, k);
                int hu = glm::dot(d * d, d * d) > 0.99 ? -1000 : 40;
                for (const double x : {0.3, 0.7}) {
                    const glm::dvec3 e((i / size.x - x) / 0.13, (j / size.y - 0.5) / 0.25, (k - size.z) / 90);
                    if (glm::dot(e, e) < 1) hu = (i % 24 < 4 && j % 24 < 4) ? 40 : -850;
                }
                if (glm::length(glm::dvec2(i - 0.5 * size.x, j - (size.y - 22))) < 14) hu = 700;
                if (mask.frame.contains(at) && mask.at(at))
                    hu = low.parts.at(low.runs, at) == static_cast<int>(pool) ? 400 : -1000;
                truth.at(i, j, k) = static_cast<std::int16_t>(hu);
            }
    });
    return test::scanned(truth, 0.0007, 20);
}

TEST(SegmentColonNightly, FindsTheLumenOfRealAnatomy) {
    if (!std::filesystem::exists(realMask())) GTEST_SKIP() << "real data absent: " << realMask();
    const MaskVolume mask = readRealMask();
    ASSERT_FALSE(mask.empty());
    const Pieces low = lowParts(mask);
    const std::uint32_t pool = largestOf(low);
    const GreyVolume study = realScan(mask, low, pool);
    const Stopwatch watch;
    const LumenField lumen = segment(study);
    std::printf("segmented in %.0f ms\n", watch.elapsed_ms());
    for (const std::string& note : lumen.notes) std::printf("note: %s\n", note.c_str());
    const auto truth = [&](glm::ivec3 v) {
        const glm::ivec3 at = v - glm::ivec3(kPad, kPad, 0);
        return mask.frame.contains(at) && mask.at(at) != 0;
    };
    const Component& box = low.parts.list[pool];
    // The pool, and two voxels around its box, without other parts of the lumen.
    const auto inFluid = [&](glm::ivec3 v) {
        const glm::ivec3 at = v - glm::ivec3(kPad, kPad, 0);
        if (glm::any(glm::lessThan(at, box.first)) || glm::any(glm::greaterThan(at, box.last + 2)))
            return false;
        return !(mask.frame.contains(at) && mask.at(at)) ||
               low.parts.at(low.runs, at) == static_cast<int>(pool);
    };
    const auto all = overlap(lumen, study.frame, truth, [](glm::ivec3) { return true; });
    const auto fluid = overlap(lumen, study.frame, truth, inFluid);
    std::printf("segments %zu, Dice %.4f (truth %zu, found %zu), in fluid %.4f (truth %zu, found %zu)\n",
                lumen.segments.size(), all.dice(), all.truth, all.found, fluid.dice(), fluid.truth,
                fluid.found);
    EXPECT_GE(all.dice(), 0.98);
    EXPECT_GE(fluid.dice(), 0.95);
    expectContract(lumen);
}

}  // namespace
}  // namespace stereonav
