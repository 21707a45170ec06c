// A made body in which everything that holds air is known: the air around it, a table's foam, lungs, a
// stomach, bowel gas, bones beside the colon, tagged fluid in it. Each piece is asked for by its place; the
// patient lies on his back or belly, and the scan's axes may be oblique.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "colon/centreline/centreline.h"
#include "colon/segmentation/segmentation_air.h"
#include "colon/segmentation/segmentation_fluid.h"
#include "engine/base/error.h"
#include "tests/support/made_ct.h"

namespace stereonav {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double kTube = 0.016;  // metres: the colon's radius
const glm::dvec3 kWay[] = {{0.09, 0.02, 0.05}, {0.09, 0.02, 0.20}, {-0.09, 0.02, 0.20}, {-0.09, 0.02, 0.06}};
const glm::dvec3 kStomach(0.06, -0.055, 0.235), kGas(0.02, -0.03, 0.12), kLung(0.08, 0, 0.345);
const glm::dvec3 kPelvis(0.09, 0.049, 0.08), kRib(-0.120, 0.02, 0.12), kFoam(0.05, 0.137, 0.15);

// Metres to the wall, negative inside.
double colonAt(const glm::dvec3& p) {
    double least = 1;
    for (int n = 0; n < 3; ++n) {
        const glm::dvec3 along = kWay[n + 1] - kWay[n];
        const double t = std::clamp(glm::dot(p - kWay[n], along) / glm::dot(along, along), 0.0, 1.0);
        least = std::min(least, glm::length(p - kWay[n] - t * along));
    }
    return least - kTube;
}

bool inEllipsoid(const glm::dvec3& p, const glm::dvec3& middle, const glm::dvec3& half) {
    const glm::dvec3 q = (p - middle) / half;
    return glm::dot(q, q) < 1;
}

bool near(const glm::dvec3& p, const glm::dvec3& middle, double radius) {
    return glm::length(p - middle) < radius;
}

// The table's box, a shell of 3 mm around foam.
int tableAt(const glm::dvec3& p) {
    const glm::dvec2 d = glm::abs(glm::dvec2(p.x, p.y - 0.1375)) - glm::dvec2(0.18, 0.0125);
    const double out = std::max(d.x, d.y);
    return out > 0 ? -1000 : out > -0.003 ? 60 : -950;
}

// back: the patient lies on his back, so fluid gathers behind; on his belly in front.
int bodyAt(const glm::dvec3& p, bool back) {
    const glm::dvec2 skin(p.x / 0.17, p.y / 0.11);
    if (glm::dot(skin, skin) > 1) return tableAt(p);
    if (colonAt(p) < 0) return (back ? p.y > 0.027 : p.y < 0.013) && p.z < 0.19 && p.x > 0 ? 400 : -1000;
    if (near(p, kStomach, 0.025) || near(p, kGas, 0.006) || near(p, kGas + glm::dvec3(-0.04, 0, 0.02), 0.007))
        return -1000;
    for (const double side : {-1.0, 1.0})
        if (inEllipsoid(p, {side * 0.08, 0, 0.36}, {0.05, 0.06, 0.10}))
            return std::fmod(p.x + 1, 0.02) < 0.004 && std::fmod(p.y + 1, 0.02) < 0.004 ? 40 : -850;
    const bool bone =
        near(p, kPelvis, 0.010) || near(p, kRib, 0.012) || glm::length(glm::dvec2(p.x, p.y - 0.075)) < 0.018;
    return bone ? 700 : 40;
}

GreyVolume scanOf(bool back, const glm::dmat3& turn) {
    VolumeFrame frame;
    frame.size = {210, 160, 190};
    frame.spacing = {0.002, 0.002, 0.0019};
    frame.axes = turn;
    frame.origin =
        glm::dvec3(0, 0.02, 0.18) - frame.axes * (0.5 * frame.spacing * glm::dvec3(frame.size - 1));
    GreyVolume truth(frame);
    parallelFor(frame.size.z, [&](int k) {
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                truth.at(i, j, k) =
                    static_cast<std::int16_t>(bodyAt(frame.worldFromVoxel(glm::dvec3(i, j, k)), back));
    });
    return test::scanned(truth, 0.0012, 15);
}

glm::dmat3 turned(double degrees, const glm::dvec3& axis) {
    return glm::mat3_cast(glm::angleAxis(glm::radians(degrees), glm::normalize(axis)));
}

AirKind kindAt(const AirPieces& air, const VolumeFrame& frame, const glm::dvec3& world) {
    const glm::ivec3 voxel(glm::round(frame.voxelFromWorld(world)));
    const int piece = air.pieces.parts.at(air.pieces.runs, voxel);
    EXPECT_GE(piece, 0) << "no air at " << world.x << ' ' << world.y << ' ' << world.z;
    return piece < 0 ? AirKind::Outside : air.kinds[static_cast<std::size_t>(piece)];
}

double diceOf(const LumenField& lumen, const VolumeFrame& study) {
    const glm::ivec3 shift(glm::round(study.voxelFromWorld(lumen.lumen.frame.worldFromVoxel(glm::dvec3(0)))));
    std::size_t truth = 0, found = 0, both = 0;
    for (int k = 0; k < study.size.z; ++k)
        for (int j = 0; j < study.size.y; ++j)
            for (int i = 0; i < study.size.x; ++i) {
                const glm::ivec3 at = glm::ivec3(i, j, k) - shift;
                const bool is = lumen.lumen.frame.contains(at) && lumen.lumen.at(at) != 0;
                const bool should = colonAt(study.worldFromVoxel(glm::dvec3(i, j, k))) < 0;
                truth += should;
                found += is;
                both += should && is;
            }
    return 2.0 * static_cast<double>(both) / static_cast<double>(truth + found);
}

LumenField lumenOf(const GreyVolume& scan) {
    Progress progress;
    return segmentColon(scan, {}, progress);
}

Centreline lineOfBody(const LumenField& lumen) {
    Progress progress;
    return findCentreline(lumen, distanceToOutside(lumen.lumen), {}, progress);
}

bool inLumen(const LumenField& lumen, const glm::dvec3& world) {
    const glm::ivec3 voxel(glm::round(lumen.lumen.frame.voxelFromWorld(world)));
    return lumen.lumen.frame.contains(voxel) && lumen.lumen.at(voxel) != 0;
}

class SegmentBody : public testing::TestWithParam<bool> {};  // on his back

TEST_P(SegmentBody, EachPieceOfAirIsToldByItsPlace) {
    const GreyVolume scan = scanOf(GetParam(), glm::dmat3(1.0));
    Progress progress;
    const AirPieces air = findAir(scan, {}, {}, progress);
    const auto kind = [&](const glm::dvec3& world) { return kindAt(air, scan.frame, world); };
    EXPECT_EQ(kind({0, -0.125, 0.1}), AirKind::Outside) << "above the patient";
    EXPECT_EQ(kind({0, 0.118, 0.1}), AirKind::Outside) << "between patient and table";
    EXPECT_EQ(kind({0.15, 0.165, 0.1}), AirKind::Outside) << "under the table";
    EXPECT_EQ(kind(kFoam), AirKind::Outside) << "the table's foam";
    EXPECT_EQ(kind(kLung + glm::dvec3(0.007, 0.007, 0)), AirKind::Lung);
    EXPECT_EQ(kind(kLung * glm::dvec3(-1, 1, 1) + glm::dvec3(-0.007, 0.007, 0)), AirKind::Lung);
    EXPECT_EQ(kind(kStomach), AirKind::Other) << "round and high up";
    EXPECT_EQ(kind(kGas), AirKind::Small) << "small bowel";
    EXPECT_EQ(kind(kWay[2]), AirKind::Colon);
    EXPECT_THAT(pieceNotes(scan, air), Contains(HasSubstr("like a stomach")));
    EXPECT_EQ(std::count(air.kinds.begin(), air.kinds.end(), AirKind::Colon), 1);
}

TEST_P(SegmentBody, BonesBesideTheColonAreNoFluid) {
    const GreyVolume scan = scanOf(GetParam(), glm::dmat3(1.0));
    Progress progress;
    AirPieces air = findAir(scan, {}, {}, progress);
    const FluidPools fluid = findFluid(scan, {}, air);
    ASSERT_EQ(fluid.pools.size(), 1u);
    EXPECT_EQ(fluid.up, GetParam() ? -1 : 1);
    const auto core = [&](const glm::dvec3& world) {
        return fluid.cores.parts.at(fluid.cores.runs,
                                    glm::ivec3(glm::round(scan.frame.voxelFromWorld(world))));
    };
    const double level = GetParam() ? 0.032 : 0.008;
    EXPECT_EQ(core({0.09, level, 0.1}), static_cast<int>(fluid.pools[0].core));
    for (const glm::dvec3& bone : {kPelvis, kRib, glm::dvec3(0, 0.075, 0.1)}) {
        ASSERT_GE(core(bone), 0);
        EXPECT_NE(core(bone), static_cast<int>(fluid.pools[0].core));
    }
    EXPECT_NEAR(fluid.pools[0].hu, 400, 30);
}

TEST_P(SegmentBody, TheLumenIsTheColonAlone) {
    const GreyVolume scan = scanOf(GetParam(), glm::dmat3(1.0));
    const LumenField lumen = lumenOf(scan);
    ASSERT_EQ(lumen.segments.size(), 1u);
    const double dice = diceOf(lumen, scan.frame);
    std::printf("Dice %.4f\n", dice);
    EXPECT_GE(dice, 0.98);
    for (const glm::dvec3& other : {kStomach, kGas, kLung, kPelvis, kRib, kFoam, glm::dvec3(0, 0.118, 0.1)})
        EXPECT_FALSE(inLumen(lumen, other));
}

// The colon filled up: what is left is named by kind, and what to do.
TEST(SegmentBodyWithoutColon, IsRefusedWithWhatWasFound) {
    GreyVolume scan = scanOf(true, glm::dmat3(1.0));
    for (int k = 0; k < scan.frame.size.z; ++k)
        for (int j = 0; j < scan.frame.size.y; ++j)
            for (int i = 0; i < scan.frame.size.x; ++i) {
                const glm::dvec3 world = scan.frame.worldFromVoxel(glm::dvec3(i, j, k));
                if (colonAt(world) < 0.005 || near(world, kStomach, 0.03)) scan.at(i, j, k) = 40;
            }
    try {
        lumenOf(scan);
        ADD_FAILURE() << "a colon was found";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("nothing like a colon in it: "));
        EXPECT_THAT(error.what(), HasSubstr("2 pieces of lung, 2 small pieces"));
        EXPECT_THAT(error.what(), HasSubstr("--seed x,y,z"));
    }
}

// The same body under a grid that is turned: the same lumen and line in the world.
TEST_P(SegmentBody, ObliqueAxesChangeNothingInTheWorld) {
    const LumenField straight = lumenOf(scanOf(GetParam(), glm::dmat3(1.0)));
    const Centreline reference = lineOfBody(straight);
    EXPECT_NEAR(reference.length(), 0.47, 0.05);  // the way of 0.47 m, ends and corners a little shorter
    const std::vector<glm::dmat3> turns = GetParam()
                                              ? std::vector{turned(15, {0, 0, 1}), turned(-12, {1, 0, 0})}
                                              : std::vector{turned(20, {0, 1, 0}), turned(14, {1, 1, 1})};
    for (const glm::dmat3& turn : turns) {
        const GreyVolume scan = scanOf(GetParam(), turn);
        const LumenField lumen = lumenOf(scan);
        ASSERT_EQ(lumen.segments.size(), 1u);
        const double dice = diceOf(lumen, scan.frame);
        const Centreline line = lineOfBody(lumen);
        double most = 0;
        for (const CentrelinePoint& point : line.points) {
            double least = 1;
            for (const CentrelinePoint& other : reference.points)
                least = std::min(least, glm::length(point.position - other.position));
            most = std::max(most, least);
            EXPECT_GT(point.radius, 0.5 * kTube);  // a lower bound, least at the inside of corners
            EXPECT_LT(point.radius, kTube + 0.002);
        }
        std::printf("turned: Dice %.4f, line of %.1f mm (%.1f), at most %.2f mm off\n", dice,
                    1000 * line.length(), 1000 * reference.length(), 1000 * most);
        EXPECT_GE(dice, 0.98);
        EXPECT_NEAR(line.length(), reference.length(), 0.01);
        EXPECT_LT(most, 0.004);
    }
}

INSTANTIATE_TEST_SUITE_P(BackAndBelly, SegmentBody, testing::Bool(), [](const auto& test) {
    return test.param ? std::string("OnHisBack") : std::string("OnHisBelly");
});

}  // namespace
}  // namespace stereonav
