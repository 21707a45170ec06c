// Unfolded walls: a tube's own size, true areas, and polyps in a strong bend that are shown once.
#include "colon/instruments/unfolding.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/colon/lumen_wall.h"
#include "tests/support/analytic_lumen.h"

namespace stereonav::test {
namespace {

constexpr double kUnfoldPi = std::numbers::pi;

struct Unfolded {
    LumenWall wall;
    Centreline line;
    WallNeighbours neighbours = neighboursOf(wall.mesh);
    LineOfSight sight = wall.sight();
    UnfoldedWall flat;

    Unfolded(LumenWall made, Centreline along)
        : wall(std::move(made)), line(std::move(along)), flat(makeFlat()) {}
    UnfoldedWall makeFlat() {
        Progress progress;
        return {wall.mesh, neighbours, line, sight, {}, progress};
    }
};

TEST(Unfolding, OfATubeIsARectangle) {
    const double radius = 0.012;
    const Unfolded tube({[=](const glm::dvec3& p) { return toTube(p, radius, -0.04, 0.04); },
                         {-0.015, -0.015, -0.043},
                         {0.015, 0.015, 0.043},
                         0.0008},
                        lineThrough({{0, 0, -0.04}, {0, 0, 0.04}}, radius));
    const double pixel = tube.flat.pixel();
    EXPECT_NEAR(tube.flat.width() * pixel, 0.08, 0.002);
    const int middle = tube.flat.width() / 2;
    int tall = 0;
    for (int y = 0; y < tube.flat.height(); ++y) tall += tube.flat.vertexAt(middle, y) != UnfoldedWall::kNone;
    EXPECT_NEAR(tall * pixel, 2 * kUnfoldPi * radius, 0.001);
    // Each quarter of the tube takes a quarter of the column, in order.
    std::vector<double> turns;
    for (int y = 0; y < tube.flat.height(); ++y)
        if (const std::uint32_t v = tube.flat.vertexAt(middle, y); v != UnfoldedWall::kNone) {
            const glm::vec3 p = tube.wall.mesh.places[v];
            EXPECT_NEAR(p.z, -0.04 + middle * pixel, 0.0012);
            turns.push_back(std::atan2(p.y, p.x));
        }
    double turned = 0;
    for (std::size_t n = 1; n < turns.size(); ++n) turned += std::remainder(turns[n] - turns[n - 1], 2 * kUnfoldPi);
    EXPECT_NEAR(std::abs(turned), 2 * kUnfoldPi, 0.15);
    const UnfoldedWall::AreaError error = tube.flat.areaError();
    EXPECT_GT(error.squares, 20);
    EXPECT_LT(error.mean, 0.05);
    EXPECT_LT(error.most95, 0.12);
}

// Three quarters of a ring, as tight as a colon's bends, with balls on its inner, outer and upper side.
TEST(Unfolding, ShowsPolypsOfABendOnce) {
    const double large = 0.028, small = 0.013;
    std::vector<glm::dvec3> heads;
    for (const double turn : {-0.6, 0.0, 0.7})
        for (const double angle : {0.0, kUnfoldPi, kUnfoldPi / 2}) {
            const double out = large + (small - 0.001) * std::cos(angle);
            heads.emplace_back(out * std::cos(turn + 0.4 * angle), out * std::sin(turn + 0.4 * angle),
                               (small - 0.001) * std::sin(angle));
        }
    const Shape ring = [=](const glm::dvec3& p) {
        const double way = std::hypot(std::hypot(p.x, p.y) - large, p.z) - small;
        double lumen = std::max(way, -p.x - 0.012 + 0.0 * p.y);
        for (const glm::dvec3& head : heads) lumen = std::max(lumen, -toBall(p, head, 0.003));
        return lumen;
    };
    std::vector<glm::dvec3> corners;
    const double most = std::acos(-0.012 / large) - 0.05;
    for (int n = 0; n <= 60; ++n) {
        const double turn = -most + 2 * most * n / 60;
        corners.emplace_back(large * std::cos(turn), large * std::sin(turn), 0);
    }
    const Unfolded bend({ring, {-0.015, -0.044, -0.016}, {0.044, 0.044, 0.016}, 0.0008},
                        lineThrough(corners, small));
    for (const glm::dvec3& head : heads) {
        std::string why;
        const auto polyp =
            polypAt(bend.wall.mesh, bend.neighbours, head, polypSettingOf(bend.wall.lumen.field.frame), why);
        ASSERT_TRUE(polyp) << why;
        const UnfoldedWall::Shown shown = bend.flat.shown(*polyp);
        EXPECT_GT(shown.share, 0.5) << head.x << ' ' << head.y << ' ' << head.z;
        EXPECT_EQ(shown.pieces, 1) << head.x << ' ' << head.y << ' ' << head.z;
    }
}

TEST(Unfolding, MakesPictures) {
    const Unfolded tube({[](const glm::dvec3& p) { return toTube(p, 0.008, -0.02, 0.02); },
                         {-0.011, -0.011, -0.023},
                         {0.011, 0.011, 0.023},
                         0.001},
                        lineThrough({{0, 0, -0.02}, {0, 0, 0.02}}, 0.008));
    const Plane<PackedColor> picture = tube.flat.picture({}), map = tube.flat.distortionMap();
    EXPECT_EQ(picture.width(), tube.flat.width());
    EXPECT_GT(picture.height(), tube.flat.height()) << "the scale";
    const glm::vec3 wall = unpackColor(picture.at(picture.width() / 2, tube.flat.height() / 2));
    EXPECT_GT(wall.x, 0.05f);
    EXPECT_LT(wall.z, 0.95f);
    EXPECT_EQ(map.width(), tube.flat.width());
}

}  // namespace
}  // namespace stereonav::test
