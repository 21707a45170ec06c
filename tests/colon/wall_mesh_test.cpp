// The wall as triangles against spheres and tubes, and lines of sight against the plain caster.
#include "colon/wall/wall_mesh.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <random>
#include <set>

#include "engine/base/parallel.h"
#include "engine/volume/plain_volume_caster.h"
#include "tests/colon/lumen_wall.h"

namespace stereonav::test {
namespace {

constexpr double kWallPi = std::numbers::pi;

LumenWall ball(double radius, double spacing) {
    return {[=](const glm::dvec3& p) {
                return toBall(p, {0.0003, -0.0002, 0.0001}, radius);
            },
            glm::dvec3(-radius - 0.003), glm::dvec3(radius + 0.003), spacing};
}

TEST(WallMesh, HasTheAreaOfABall) {
    const double radius = 0.012, area = 4 * kWallPi * radius * radius;
    const LumenWall fine = ball(radius, 0.0008), coarse = ball(radius, 0.0016);
    const double offFine = 1 - fine.mesh.area() / area, offCoarse = 1 - coarse.mesh.area() / area;
    EXPECT_NEAR(offFine, 0, 0.003);
    // The error is of second order: half the spacing has a quarter of it.
    EXPECT_LT(std::abs(offFine), 0.4 * std::abs(offCoarse));
}

TEST(WallMesh, HasTheAreaOfATube) {
    const double radius = 0.01, from = -0.02, to = 0.02;
    const LumenWall tube([=](const glm::dvec3& p) { return toTube(p, radius, from, to); },
                         {-0.013, -0.013, -0.023}, {0.013, 0.013, 0.023}, 0.0007);
    const double area = 2 * kWallPi * radius * (to - from) + 2 * kWallPi * radius * radius;
    EXPECT_NEAR(tube.mesh.area() / area, 1, 0.02) << "edges are rounded off";
}

TEST(WallMesh, ClosesAndLooksInwards) {
    const LumenWall wall = ball(0.008, 0.001);
    const WallMesh& mesh = wall.mesh;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& t : mesh.triangles)
        for (int n = 0; n < 3; ++n) ++sides[{t[n], t[(n + 1) % 3]}];
    for (const auto& [side, count] : sides) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(sides.contains({side.second, side.first}));
    }
    const auto v = static_cast<int>(mesh.places.size()), f = static_cast<int>(mesh.triangles.size());
    EXPECT_EQ(v - static_cast<int>(sides.size()) / 2 + f, 2) << "Euler's number of a sphere";
    for (int n = 0; n < v; ++n) EXPECT_GT(glm::dot(mesh.normals[n], -glm::normalize(mesh.places[n])), 0.95f);
}

// The patient's axes of some files are left-handed.
TEST(WallMesh, LooksInwardsWhereAxesAreMirrored) {
    LumenField lumen = lumenOf([](const glm::dvec3& p) { return toBall(p, glm::dvec3(0), 0.006); },
                               glm::dvec3(-0.009), glm::dvec3(0.009), glm::dvec3(0.001));
    lumen.field.frame.axes[0] *= -1.0;
    lumen.lumen.frame = lumen.field.frame;
    const glm::vec3 middle(lumen.field.frame.worldFromVoxel(glm::dvec3(9)));
    const LumenWall wall(std::move(lumen));
    for (std::size_t n = 0; n < wall.mesh.places.size(); ++n)
        EXPECT_GT(glm::dot(wall.mesh.normals[n], glm::normalize(middle - wall.mesh.places[n])), 0.9f);
}

TEST(WallMesh, IsTheSameOnAnyNumberOfThreads) {
    const int before = threadCount();
    setThreadCount(1);
    const LumenWall one = ball(0.02, 0.0007);
    setThreadCount(3);
    const LumenWall three = ball(0.02, 0.0007);
    setThreadCount(before);
    EXPECT_EQ(one.mesh.places, three.mesh.places);
    EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
    EXPECT_EQ(one.mesh.areas, three.mesh.areas);
}

TEST(WallMesh, NeighboursAreThoseOfTheTriangles) {
    const LumenWall wall = ball(0.006, 0.001);
    const WallNeighbours neighbours = neighboursOf(wall.mesh);
    ASSERT_EQ(neighbours.first.size(), wall.mesh.places.size() + 1);
    std::map<std::uint32_t, std::set<std::uint32_t>> expected;
    for (const auto& t : wall.mesh.triangles)
        for (int n = 0; n < 3; ++n) expected[t[n]].insert({t[(n + 1) % 3], t[(n + 2) % 3]});
    for (const auto& [v, all] : expected) {
        const std::vector<std::uint32_t> found(neighbours.neighbours.begin() + neighbours.first[v],
                                               neighbours.neighbours.begin() + neighbours.first[v + 1]);
        EXPECT_EQ(found, std::vector<std::uint32_t>(all.begin(), all.end()));
    }
}

// A bent lumen: two tubes that meet at a right angle, with a ball in one of them.
LumenWall bent() {
    return {[](const glm::dvec3& p) {
                const double along = std::max(std::hypot(p.x, p.y) - 0.006, std::abs(p.z) - 0.02);
                const double across =
                    std::max(std::hypot(p.x - 0.0, p.z - 0.014) - 0.006, std::abs(p.y - 0.012) - 0.014);
                return std::max(std::min(along, across),
                                0.003 - glm::length(p - glm::dvec3(0.001, 0, -0.006)));
            },
            {-0.009, -0.009, -0.023},
            {0.009, 0.029, 0.023},
            0.0008};
}

TEST(LineOfSight, AgreesWithThePlainCaster) {
    const LumenWall wall = bent();
    const LineOfSight sight = wall.sight();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> x(-0.006, 0.006), y(-0.006, 0.026), z(-0.02, 0.02);
    int asked = 0, clear = 0, differ = 0;
    while (asked < 4000) {
        const glm::dvec3 a(x(random), y(random), z(random)), b(x(random), y(random), z(random));
        if (sight.valueAt(a) >= wall.lumen.isovalue || sight.valueAt(b) >= wall.lumen.isovalue) continue;
        ++asked;
        const bool truth = !(castPlainVolume(wall.lumen.field, wall.lumen.isovalue, {a, b - a, 0}).t <= 1);
        clear += truth;
        differ += truth != sight.clear(a, b);
        if (!truth) continue;
        EXPECT_TRUE(sight.clear(a, b)) << "no wall is seen where there is none";
    }
    EXPECT_GT(clear, 400);
    EXPECT_LT(clear, 3600);
    EXPECT_EQ(differ, 0);
}

// A septum of one voxel as smoothing leaves it of a mask, less than a tenth of a voxel thick: nothing is seen
// through it, at any angle.
TEST(LineOfSight, DoesNotPassThinFlesh) {
    LumenField lumen = lumenOf([](const glm::dvec3& p) { return toBall(p, glm::dvec3(0.0), 0.012); },
                               glm::dvec3(-0.015), glm::dvec3(0.015), glm::dvec3(0.001));
    for (int j = 0; j < lumen.field.frame.size.y; ++j)
        for (int i = 0; i < lumen.field.frame.size.x; ++i)
            for (int k = 14; k <= 16; ++k) {
                std::int16_t& value = lumen.field.at(i, j, k);
                value = std::max<std::int16_t>(value, k == 15 ? -440 : -700);
                if (value >= lumen.isovalue) lumen.lumen.at(i, j, k) = 0;
            }
    const LumenWall wall(std::move(lumen));
    const LineOfSight sight = wall.sight();
    std::mt19937 random(9);
    std::uniform_real_distribution<double> across(-0.006, 0.006), off(0.0012, 0.006);
    for (int n = 0; n < 2000; ++n) {
        const glm::dvec3 a(across(random), across(random), -off(random)),
            b(across(random), across(random), off(random));
        ASSERT_LT(sight.valueAt(a), wall.lumen.isovalue);
        EXPECT_FALSE(sight.clear(a, b)) << n;
        EXPECT_FALSE(sight.clear(b, a)) << n;
        const glm::dvec3 way = glm::normalize(b - a);
        const PlainHit hit = castPlainVolume(wall.lumen.field, wall.lumen.isovalue, {a, way, 0});
        EXPECT_NEAR(sight.reach(a, way, 1), hit.t, 1e-9) << n;
    }
}

TEST(LineOfSight, EndsInTheWallAndOutsideAreNotClear) {
    const LumenWall wall = bent();
    const LineOfSight sight = wall.sight();
    EXPECT_TRUE(sight.clear({0, 0, 0.01}, {0, 0, 0.01}));
    EXPECT_FALSE(sight.clear({0, 0, 0.01}, {0.008, 0, 0.01}));
    EXPECT_FALSE(sight.clear({0, 0, 0.01}, {1, 0, 0.01}));
    EXPECT_FALSE(sight.clear({1, 0, 0}, {1, 0, 0.01}));
    EXPECT_NEAR(sight.reach({0, 0, 0.004}, {1, 0, 0}, 1), 0.006, 0.0003);
    EXPECT_EQ(sight.reach({0, 0, 0.004}, {0, 0, 1}, 0.005), 0.005);
    EXPECT_EQ(sight.reach({0.0085, 0, 0.004}, {1, 0, 0}, 1), 0);
}

}  // namespace
}  // namespace stereonav::test
