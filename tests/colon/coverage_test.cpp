// Coverage against closed forms in a tube, and against the plain caster where there is a fold.
#include "colon/instruments/coverage.h"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/volume/plain_volume_caster.h"
#include "tests/colon/lumen_wall.h"
#include "tests/support/analytic_lumen.h"

namespace stereonav::test {
namespace {

constexpr double kCoveragePi = std::numbers::pi;
constexpr double kRadius = 0.01, kFrom = -0.03, kTo = 0.03;

const LumenWall& tube() {
    static const LumenWall wall([](const glm::dvec3& p) { return toTube(p, kRadius, kFrom, kTo); },
                                {-0.013, -0.013, -0.033}, {0.013, 0.013, 0.033}, 0.0006);
    return wall;
}
// The tube with a ring of 5 mm in its middle.
const LumenWall& folded() {
    static const LumenWall wall(
        [](const glm::dvec3& p) {
            const double ring = std::hypot(std::hypot(p.x, p.y) - kRadius, 2.5 * p.z) - 0.005;
            return std::max(toTube(p, kRadius, kFrom, kTo), -ring);
        },
        {-0.013, -0.013, -0.033}, {0.013, 0.013, 0.033}, 0.0006);
    return wall;
}
Coverage::FreeDistance freeIn(const LumenWall& wall) {
    return [&wall](const glm::dvec3& p, double upTo) { return wall.freeDistanceAt(p, upTo); };
}

// Square millimetres seen of the tube's side from the axis at z, looking along z, by a square picture: a
// point at this angle about the axis is on screen from a depth of radius * max(|cos|, |sin|) / tan(fov / 2)
// on.
double sideSeen(double fov, double upTo) {
    const double onScreen = kRadius / std::tan(fov / 2) * std::sin(kCoveragePi / 4) / (kCoveragePi / 4);
    return 2 * kCoveragePi * kRadius * (upTo - onScreen);
}

double seenArea(const LumenWall& wall, const Coverage& coverage) {
    double side = 0;  // without the ends
    for (std::size_t v = 0; v < wall.mesh.places.size(); ++v)
        if (coverage.seen()[v] && std::abs(wall.mesh.places[v].z) < kTo - 0.001) side += wall.mesh.areas[v];
    return side;
}

TEST(Coverage, OfATubeFromItsAxisIsKnown) {
    const LineOfSight sight = tube().sight();
    const Pose eye = lookingAlong({0, 0, -0.02}, {0, 0, 1});
    Progress progress;
    for (const double degrees : {60.0, 90.0, 120.0}) {
        CoverageSetting setting;
        setting.verticalFov = degrees * kCoveragePi / 180;
        setting.within = 0.03;
        setting.angle = kCoveragePi / 2;
        Coverage byDistance(tube().mesh, tube().neighbours, sight, setting);
        byDistance.look({&eye, 1}, progress);
        const double reach = std::sqrt(setting.within * setting.within - kRadius * kRadius);
        EXPECT_NEAR(seenArea(tube(), byDistance) / sideSeen(setting.verticalFov, reach), 1, 0.01) << degrees;
        setting.within = 1;
        setting.angle = 70 * kCoveragePi / 180;
        Coverage byAngle(tube().mesh, tube().neighbours, sight, setting);
        byAngle.look({&eye, 1}, progress);
        const double slant = kRadius * std::tan(setting.angle);
        EXPECT_NEAR(seenArea(tube(), byAngle) / sideSeen(setting.verticalFov, slant), 1, 0.025) << degrees;
    }
}

TEST(Coverage, WideAndTallPicturesShowWhatTheyFrame) {
    const LineOfSight sight = tube().sight();
    const Pose eye = lookingAlong({0, 0, -0.02}, {0, 0, 1});
    Progress progress;
    CoverageSetting setting;
    setting.aspect = 3;
    Coverage wide(tube().mesh, tube().neighbours, sight, setting);
    wide.look({&eye, 1}, progress);
    const auto right = static_cast<glm::vec3>(eye.right()), up = static_cast<glm::vec3>(eye.up());
    for (std::size_t v = 0; v < tube().mesh.places.size(); ++v) {
        const glm::vec3 to = tube().mesh.places[v] - glm::vec3(eye.position);
        if (!wide.seen()[v]) continue;
        EXPECT_LE(std::abs(glm::dot(to, up)), to.z * 1.0001);
        EXPECT_LE(std::abs(glm::dot(to, right)), to.z * 3.0001);
    }
    setting.aspect = 1;
    Coverage square(tube().mesh, tube().neighbours, sight, setting);
    square.look({&eye, 1}, progress);
    EXPECT_GT(wide.percent(), square.percent() + 1);
}

TEST(Coverage, HidesWhatIsBehindAFold) {
    const LumenWall& wall = folded();
    const LineOfSight sight = wall.sight();
    const Pose eye = lookingAlong({0.001, 0, -0.02}, {0, 0, 1});
    Progress progress;
    CoverageSetting setting;
    setting.within = 1;
    setting.angle = kCoveragePi / 2;
    Coverage coverage(wall.mesh, wall.neighbours, sight, setting);
    coverage.look({&eye, 1}, progress);
    int asked = 0, differ = 0, hidden = 0;
    for (std::size_t v = 0; v < wall.mesh.places.size(); v += 7) {
        const glm::dvec3 place(wall.mesh.places[v]), normal(wall.mesh.normals[v]), to = place - eye.position;
        if (to.z <= std::max(std::abs(to.x), std::abs(to.y)) || glm::dot(to, normal) >= 0) continue;
        const glm::dvec3 end = place + 0.0003 * normal;
        const PlainHit hit =
            castPlainVolume(wall.lumen.field, wall.lumen.isovalue, {eye.position, end - eye.position, 0});
        ++asked;
        hidden += hit.t <= 1;
        differ += (hit.t > 1) != (coverage.seen()[v] != 0);
    }
    EXPECT_GT(asked, 500);
    EXPECT_GT(hidden, 50);
    EXPECT_LE(differ, asked / 200);
}

TEST(Coverage, PatchesAreWhatIsLeft) {
    const LumenWall& wall = folded();
    const LineOfSight sight = wall.sight();
    Progress progress;
    CoverageSetting setting;
    setting.smallestPatch = 50e-6;
    Coverage coverage(wall.mesh, wall.neighbours, sight, setting);
    EXPECT_EQ(coverage.percent(), 0);
    const std::vector<UnseenPatch> all = coverage.patches(freeIn(wall), 0.001);
    ASSERT_EQ(all.size(), 1u) << "nothing was looked at";
    EXPECT_NEAR(all[0].area / wall.mesh.area(), 1, 1e-4);
    const Pose eyes[] = {lookingAlong({0, 0, -0.025}, {0, 0, 1}), lookingAlong({0, 0, -0.005}, {0, 0, -1})};
    coverage.look(eyes, progress);
    const std::vector<UnseenPatch> left = coverage.patches(freeIn(wall), 0.001);
    ASSERT_FALSE(left.empty());
    double area = 0, listed = 0;
    for (std::size_t v = 0; v < wall.mesh.places.size(); ++v)
        if (!coverage.seen()[v]) area += wall.mesh.areas[v];
    for (const UnseenPatch& patch : left) {
        EXPECT_GE(patch.area, 50e-6);
        listed += patch.area;
        EXPECT_TRUE(patch.view.has_value());
    }
    EXPECT_LE(listed, area * 1.0001);
    EXPECT_GT(listed, 0.8 * area);
    EXPECT_GT(left[0].place.z, 0.0) << "behind the fold";
    const double before = coverage.percent();
    const int views = coverage.visit(left, freeIn(wall), 0.001, progress);
    EXPECT_GE(views, static_cast<int>(left.size()));
    EXPECT_GT(coverage.percent(), before + 10);
    setting.smallestPatch = 1;
    EXPECT_TRUE(Coverage(wall.mesh, wall.neighbours, sight, setting).patches(freeIn(wall), 0.001).empty());
}

// The view of a patch shows its place.
TEST(Coverage, ViewsShowTheirPatch) {
    const LumenWall& wall = folded();
    const LineOfSight sight = wall.sight();
    Progress progress;
    Coverage coverage(wall.mesh, wall.neighbours, sight, {});
    const std::vector<UnseenPatch> all = coverage.patches(freeIn(wall), 0.001);
    ASSERT_TRUE(all.at(0).view);
    EXPECT_GE(wall.freeDistanceAt(all[0].view->position, 0.001), 0.001 * 0.999);
    coverage.look({&*all[0].view, 1}, progress);
    for (const std::uint32_t v : all[0].vertices) {
        if (glm::dvec3(wall.mesh.places[v]) != all[0].place) continue;
        EXPECT_TRUE(coverage.seen()[v]);
    }
}

TEST(Coverage, IsTheSameOnAnyNumberOfThreads) {
    const LineOfSight sight = folded().sight();
    const Pose eye = lookingAlong({0, 0, -0.02}, {0, 0, 1});
    Progress progress;
    const int before = threadCount();
    std::vector<std::vector<std::uint8_t>> seen;
    for (const int threads : {1, 3}) {
        setThreadCount(threads);
        Coverage coverage(folded().mesh, folded().neighbours, sight, {});
        coverage.look({&eye, 1}, progress);
        seen.push_back(coverage.seen());
    }
    setThreadCount(before);
    EXPECT_EQ(seen[0], seen[1]);
}

TEST(Coverage, RefusesSettingsOutOfRange) {
    const LineOfSight sight = tube().sight();
    const auto refused = [&](auto change) {
        CoverageSetting setting;
        change(setting);
        EXPECT_THROW(Coverage(tube().mesh, tube().neighbours, sight, setting), Error);
    };
    refused([](CoverageSetting& s) { s.verticalFov = kCoveragePi; });
    refused([](CoverageSetting& s) { s.verticalFov = std::nan(""); });
    refused([](CoverageSetting& s) { s.aspect = 0; });
    refused([](CoverageSetting& s) { s.within = 0; });
    refused([](CoverageSetting& s) { s.angle = 0; });
    refused([](CoverageSetting& s) { s.angle = 2; });
    refused([](CoverageSetting& s) { s.smallestPatch = -1; });
}

// A picture whose window is not in its middle, as one of two eyes has, shows more to one side.
TEST(Coverage, LooksThroughThePicturesOwnWindow) {
    const LineOfSight sight = tube().sight();
    const Pose eye = lookingAlong({0, 0, -0.02}, {0, 0, 1});
    Progress progress;
    CoverageSetting setting;
    setting.within = 0.03;
    const double side = std::tan(0.5 * setting.verticalFov);
    EyeView view;
    view.eye = eye.position;
    view.right = eye.right(), view.up = eye.up(), view.forward = eye.forward();
    view.xMin = view.yMin = -side;
    view.xMax = view.yMax = side;
    Coverage byPose(tube().mesh, tube().neighbours, sight, setting),
        byView(tube().mesh, tube().neighbours, sight, setting);
    byPose.look({&eye, 1}, progress);
    byView.look({&view, 1}, progress);
    EXPECT_EQ(byPose.seen(), byView.seen());
    byView.startAgain(setting);
    EXPECT_EQ(byView.percent(), 0);
    view.xMin = 0;
    byView.look({&view, 1}, progress);
    EXPECT_NEAR(seenArea(tube(), byView) / seenArea(tube(), byPose), 0.5, 0.01);
    setting.within = -1;
    EXPECT_THROW(byView.startAgain(setting), Error);
}

}  // namespace
}  // namespace stereonav::test
