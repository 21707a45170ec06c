// Curvatures against closed forms, and polyps of known size.
#include "colon/instruments/polyp.h"

#include <gtest/gtest.h>

#include <numbers>

#include "colon/instruments/finding.h"
#include "tests/colon/lumen_wall.h"

namespace stereonav::test {
namespace {

constexpr double kPolypPi = std::numbers::pi;

// A tube along z of radius 14 mm with flesh where `flesh` is negative.
LumenWall tubeWith(const Shape& flesh) {
    return {[flesh](const glm::dvec3& p) { return std::max(toTube(p, 0.014, -0.02, 0.02), -flesh(p)); },
            {-0.017, -0.017, -0.023},
            {0.017, 0.017, 0.023},
            0.0007};
}

// A ball on a stalk from the wall at x = 14 mm.
double stalked(const glm::dvec3& p, double radius) {
    const double head = toBall(p, {0.005, 0, 0}, radius);
    const double stalk = p.x > 0.005 ? std::hypot(p.y, p.z) - 0.0015 : 1.0;
    return std::min(head, stalk);
}

TEST(WallCurvature, OfATubeAndABall) {
    const LumenWall wall = tubeWith([](const glm::dvec3& p) { return toBall(p, {0, 0, 0}, 0.005); });
    const WallNeighbours neighbours = neighboursOf(wall.mesh);
    const Curvatures tube =
        curvaturesAt(wall.mesh, neighbours, nearestVertex(wall.mesh, {0.014, 0, 0.008}), 0.003);
    EXPECT_NEAR(tube.larger, 0, 4);
    EXPECT_NEAR(tube.smaller, -1 / 0.014, 4);
    EXPECT_NEAR(tube.shapeIndex(), 0.25, 0.03);
    const Curvatures ball =
        curvaturesAt(wall.mesh, neighbours, nearestVertex(wall.mesh, {0.005, 0, 0}), 0.002);
    EXPECT_NEAR(ball.larger, 200, 20);
    EXPECT_NEAR(ball.smaller, 200, 20);
    EXPECT_NEAR(ball.shapeIndex(), 1, 0.08);
    EXPECT_NEAR(ball.curvedness(), 200, 20);
    EXPECT_EQ(Curvatures{}.shapeIndex(), 0.5);
}

TEST(Polyp, OfAHeadOnAStalk) {
    for (const double radius : {0.003, 0.005}) {
        const LumenWall wall = tubeWith([=](const glm::dvec3& p) { return stalked(p, radius); });
        std::string why;
        const auto polyp = polypAt(wall.mesh, neighboursOf(wall.mesh), {0.005, 0, 0},
                                   polypSettingOf(wall.lumen.field.frame), why);
        ASSERT_TRUE(polyp) << why;
        EXPECT_NEAR(polyp->widest.length, 2 * radius, 0.0007);
        EXPECT_NEAR(polyp->widestInSlice.length, 2 * radius, 0.0007);
        EXPECT_NEAR(polyp->volume / (4.0 / 3 * kPolypPi * radius * radius * radius), 1, 0.15);
        EXPECT_NEAR(polyp->area / (4 * kPolypPi * radius * radius), 0.9, 0.15);
        EXPECT_LT(polyp->outward.x, -0.9) << "away from its stalk";
        EXPECT_NEAR(glm::distance(polyp->widest.from, polyp->widest.to), polyp->widest.length, 1e-9);
    }
}

TEST(Polyp, OfACapOnTheWall) {
    const LumenWall wall = tubeWith([](const glm::dvec3& p) { return toBall(p, {0.013, 0, 0}, 0.004); });
    std::string why;
    const auto polyp = polypAt(wall.mesh, neighboursOf(wall.mesh), {0.012, 0, 0.001},
                               polypSettingOf(wall.lumen.field.frame), why);
    ASSERT_TRUE(polyp) << why;
    EXPECT_NEAR(polyp->widest.length, 0.008, 0.001);
    EXPECT_LT(polyp->volume, 4.0 / 3 * kPolypPi * 0.004 * 0.004 * 0.004);
}

TEST(Polyp, IsNotFoundWhereThereIsNone) {
    // A fold all around bulges one way only.
    const LumenWall wall =
        tubeWith([](const glm::dvec3& p) { return std::hypot(std::hypot(p.x, p.y) - 0.014, p.z) - 0.004; });
    const WallNeighbours neighbours = neighboursOf(wall.mesh);
    std::string why;
    EXPECT_FALSE(polypAt(wall.mesh, neighbours, {0.010, 0, 0}, {}, why));
    EXPECT_EQ(why, "nothing bulges into the lumen there");
    EXPECT_FALSE(polypAt(wall.mesh, neighbours, {0.014, 0, 0.012}, {}, why));
    EXPECT_FALSE(polypAt(wall.mesh, neighbours, {0.3, 0, 0}, {}, why));
    EXPECT_EQ(why, "no wall of the colon is within 20 mm");
    const LumenWall balls = tubeWith([](const glm::dvec3& p) { return toBall(p, {0.005, 0, 0}, 0.005); });
    PolypSetting small;
    small.largest = 0.003;
    EXPECT_FALSE(polypAt(balls.mesh, neighboursOf(balls.mesh), {0.005, 0, 0.005}, small, why));
    EXPECT_EQ(why, "what bulges there is wider than 3 mm");
}

// A bump of less than six voxels, or lower than half of one, is what noise makes of any wall.
TEST(Polyp, IsNotWhatNoiseMakes) {
    struct Bump {
        double radius, out;  // metres: a ball, and how far it stands out
        bool polyp;
    };
    for (const Bump& bump : {Bump{0.002, 0.002, true},
                             {0.003, 0.0015, true},
                             {0.0012, 0.0006, false},
                             {0.0008, 0.0009, false},
                             {0.01, 0.0003, false}}) {
        const LumenWall wall = tubeWith([&](const glm::dvec3& p) {
            return toBall(p, {0.014 - bump.out + bump.radius, 0, 0}, bump.radius);
        });
        std::string why;
        const PolypSetting setting = polypSettingOf(wall.lumen.field.frame);
        EXPECT_NEAR(setting.leastVolume, 6 * 0.0007 * 0.0007 * 0.0007, 1e-15);
        const auto polyp = polypAt(wall.mesh, wall.neighbours, {0.014 - bump.out, 0, 0}, setting, why);
        EXPECT_EQ(polyp.has_value(), bump.polyp) << bump.radius << " " << bump.out << " " << why;
    }
}

Finding ofSize(double mm) {
    Finding finding;
    finding.polyp.emplace();
    finding.polyp->widest.length = 1e-3 * mm;
    return finding;
}

TEST(Findings, AreClassedBySizeAndCount) {
    EXPECT_EQ(cradsClassOf({}), "C1");
    EXPECT_EQ(cradsClassOf({ofSize(5.9), Finding{}}), "C1");
    EXPECT_EQ(cradsClassOf({ofSize(6), ofSize(9.9)}), "C2");
    EXPECT_EQ(cradsClassOf({ofSize(6), ofSize(7), ofSize(8)}), "C3");
    EXPECT_EQ(cradsClassOf({ofSize(10)}), "C3");
    EXPECT_EQ(cradsClassOf({ofSize(30)}), "C4");
    std::vector<Finding> doubled{ofSize(8), ofSize(8), ofSize(7)};
    doubled[1].polyp->tip = 3;
    doubled[0].polyp->vertices = {1, 3};
    doubled[2].polyp->tip = 9;
    noteDoubles(doubled);
    EXPECT_EQ(doubled[1].problem, "the same polyp as finding 1");
    EXPECT_EQ(doubled[2].problem, "");
    EXPECT_EQ(cradsClassOf(doubled), "C2") << "one polyp counts once";
}

// What nobody has looked at classes nothing.
TEST(Findings, AreClassedByWhatAPersonKept) {
    Finding large = ofSize(12), small = ofSize(7);
    large.candidate = true;
    EXPECT_EQ(cradsClassOf({large}), "") << "there are candidates alone";
    EXPECT_EQ(cradsClassOf({large, large, large}), "");
    EXPECT_EQ(cradsClassOf({large, small}), "C2");
    EXPECT_EQ(cradsClassOf({small, large}), "C2");
    EXPECT_EQ(cradsClassOf({Finding{}, large}), "C1") << "a place without a polyp was looked at";
    large.candidate = false;
    EXPECT_EQ(cradsClassOf({large, small}), "C3");
}

TEST(Findings, OfTheSamePlaceAreOne) {
    const auto at = [](double x, std::uint32_t tip, bool candidate, const char* comment) {
        Finding finding = ofSize(8);
        finding.asked = {x, 0, 0};
        finding.polyp->tip = tip;
        finding.polyp->vertices = {tip, tip + 1};
        finding.candidate = candidate;
        finding.comment = comment;
        return finding;
    };
    std::vector<Finding> list;
    const auto add = [&](const Finding& finding) { addFinding(list, finding); };
    add(at(0.01, 10, true, "candidate 1"));
    add(at(0.02, 20, true, "candidate 2"));
    add(at(0.01, 10, true, "candidate 1"));
    add(at(0.02, 20, true, "candidate 2"));
    ASSERT_EQ(list.size(), 2u) << "the same candidates again";
    // A person points at another place of the first one's head.
    Finding pointed = at(0.013, 15, false, "looked at");
    add(pointed);
    ASSERT_EQ(list.size(), 3u) << "its tip is not of the candidate's";
    list.pop_back();
    pointed.polyp->tip = 11;
    add(pointed);
    ASSERT_EQ(list.size(), 2u);
    EXPECT_FALSE(list[0].candidate);
    EXPECT_EQ(list[0].comment, "looked at");
    add(at(0.01, 10, true, "candidate 1"));
    ASSERT_EQ(list.size(), 2u);
    EXPECT_FALSE(list[0].candidate) << "a candidate again does not undo what a person said";
    EXPECT_EQ(list[0].comment, "looked at");
    // Places of a person are told apart by half a millimetre.
    add(at(0.0101, 10, false, "again"));
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].comment, "again");
    add(at(0.0101, 10, false, ""));
    EXPECT_EQ(list[0].comment, "again");
    add(at(0.012, 10, false, "another place of it"));
    ASSERT_EQ(list.size(), 3u);
    // Two places without a polyp.
    Finding none;
    none.asked = {0.5, 0, 0};
    add(none), add(none);
    none.asked.x = 0.502;
    add(none);
    EXPECT_EQ(list.size(), 5u);
}

TEST(Findings, AreRightWithinAMillimetreOrATenth) {
    Finding finding = ofSize(5.1);
    EXPECT_TRUE(finding.right());
    finding.truth.emplace();
    finding.truth->diameter = 0.006;
    EXPECT_TRUE(finding.right());
    finding.truth->diameter = 0.0062;
    EXPECT_FALSE(finding.right());
    finding.polyp.reset();
    EXPECT_FALSE(finding.right());
}

// A frame's outline of a colon: up on the left, across, down on the right.
TEST(Findings, SegmentsAreToldByLandmarks) {
    Centreline line;
    const glm::dvec3 corners[] = {{0, 0.08, -0.14}, {0, 0.08, 0.0},      {0.1, 0, -0.1},  {0.12, 0.05, 0.15},
                                  {0, -0.05, 0.0},  {-0.11, 0.05, 0.12}, {-0.1, 0, -0.06}};
    for (int n = 0; n + 1 < 7; ++n)
        for (int k = 0; k < 100; ++k)
            line.points.push_back({glm::mix(corners[n], corners[n + 1], k / 100.0), 0.015, 1});
    const auto segmentOf = [&](const glm::dvec3& p) { return colonSegmentAt(line, alongLine(line, p)); };
    EXPECT_EQ(segmentOf({0, 0.08, -0.1}), "rectum");
    EXPECT_EQ(segmentOf({0.05, 0.04, -0.05}), "sigmoid");
    EXPECT_EQ(segmentOf({0.11, 0.025, 0.02}), "descending");
    EXPECT_EQ(segmentOf({0.12, 0.05, 0.15}), "splenic flexure");
    EXPECT_EQ(segmentOf({0, -0.05, 0}), "transverse");
    EXPECT_EQ(segmentOf({-0.11, 0.05, 0.12}), "hepatic flexure");
    EXPECT_EQ(segmentOf({-0.105, 0.025, 0.03}), "ascending");
    EXPECT_EQ(segmentOf({-0.1, 0, -0.05}), "caecum");
    Centreline straight;
    for (int n = 0; n < 10; ++n) straight.points.push_back({{0, 0, 0.01 * n}, 0.01, 1});
    EXPECT_EQ(colonSegmentAt(straight, 0.05), "") << "no flexures";
}

}  // namespace
}  // namespace stereonav::test
