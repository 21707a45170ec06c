// Unfolded walls: a tube's own size, true areas, and polyps in a strong bend that are shown once.
#include "colon/instruments/unfolding.h"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/base/error.h"
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

// A tube along z with half balls at its ends.
double toCapsule(const glm::dvec3& p, double radius, double half) {
    return toBall(p, {0, 0, std::clamp(p.z, -half, half)}, radius);
}

// Slices of a ball have the area of those of the tube around it (Archimedes), so the ends are as high too.
TEST(Unfolding, OfATubeIsARectangle) {
    const double radius = 0.012;
    const Unfolded tube({[=](const glm::dvec3& p) { return toCapsule(p, radius, 0.04); },
                         {-0.015, -0.015, -0.055},
                         {0.015, 0.015, 0.055},
                         0.0008},
                        lineThrough({{0, 0, -0.03}, {0, 0, 0.035}}, radius));
    const UnfoldedWall& flat = tube.flat;
    const double pixel = flat.pixel();
    EXPECT_NEAR(flat.width() * pixel, 0.104, 0.006);
    EXPECT_LT(flat.height() * pixel, 2 * kUnfoldPi * radius * 1.1) << "no column is higher than the tube";
    EXPECT_NEAR((flat.columnAt(0.04) - flat.columnAt(0.02)) * pixel, 0.02, 1e-4);
    EXPECT_NEAR(flat.alongAt(flat.columnAt(0.03)), 0.03, 1e-9);
    const int middle = static_cast<int>(std::lround(flat.columnAt(0.03)));
    int tall = 0;
    for (int y = 0; y < flat.height(); ++y) tall += flat.vertexAt(middle, y) != UnfoldedWall::kNone;
    EXPECT_NEAR(tall * pixel, 2 * kUnfoldPi * radius, 0.001);
    std::vector<double> turns;
    for (int y = 0; y < flat.height(); ++y)
        if (const auto p = flat.placeAt(middle, y)) {
            EXPECT_NEAR(p->z, -0.03 + flat.alongAt(middle), 0.0012);
            turns.push_back(std::atan2(p->y, p->x));
        }
    double turned = 0;
    for (std::size_t n = 1; n < turns.size(); ++n)
        turned += std::remainder(turns[n] - turns[n - 1], 2 * kUnfoldPi);
    EXPECT_NEAR(std::abs(turned), 2 * kUnfoldPi, 0.15) << "around once";
    std::size_t pixels = 0;
    for (int y = 0; y < flat.height(); ++y)
        for (int x = 0; x < flat.width(); ++x) pixels += flat.vertexAt(x, y) != UnfoldedWall::kNone;
    EXPECT_NEAR(static_cast<double>(pixels) * pixel * pixel / tube.wall.mesh.area(), 1, 0.04);
    const UnfoldedWall::AreaError error = flat.areaError();
    EXPECT_GT(error.squares, 20);
    EXPECT_LT(error.mean, 0.06);
    EXPECT_LT(error.most95, 0.15);
    EXPECT_LT(flat.hiddenShare(0.002), 0.02);
    EXPECT_FALSE(flat.placeAt(-1, 0));
    EXPECT_FALSE(flat.placeAt(0, flat.height()));
}

// From a place to its pixel and back.
TEST(Unfolding, LinksPlacesAndPixels) {
    const Unfolded tube({[=](const glm::dvec3& p) { return toTube(p, 0.012, -0.04, 0.04); },
                         {-0.015, -0.015, -0.043},
                         {0.015, 0.015, 0.043},
                         0.0008},
                        lineThrough({{0, 0, -0.03}, {0, 0, 0.03}}, 0.012));
    int tried = 0;
    for (std::uint32_t v = 0; v < tube.wall.mesh.places.size(); v += 7) {
        const glm::dvec3 place(tube.wall.mesh.places[v]);
        if (std::abs(place.z) > 0.03) continue;
        const glm::dvec2 p = tube.flat.pixelOf(v);
        const int y = std::clamp(static_cast<int>(std::lround(p.y)), 1, tube.flat.height() - 2);
        const auto shown = tube.flat.placeAt(static_cast<int>(std::lround(p.x)), y);
        if (!shown) continue;  // at the cut
        ++tried;
        EXPECT_LT(glm::distance(*shown, place), 1.5 * tube.flat.pixel()) << place.x << ' ' << place.z;
    }
    EXPECT_GT(tried, 500);
}

// A wave along a tube is damped by 1 / (1 + (length * wave number)^2); what is even stays.
TEST(Unfolding, NumbersAreSmoothedWithoutDrift) {
    const LumenWall tube([](const glm::dvec3& p) { return toTube(p, 0.012, -0.05, 0.05); },
                         {-0.015, -0.015, -0.053}, {0.015, 0.015, 0.053}, 0.0008);
    const double wave = 2 * kUnfoldPi / 0.02, length = 0.003;
    std::vector<glm::vec3> values;
    for (const glm::vec3& place : tube.mesh.places) values.emplace_back(std::cos(wave * place.z), place.z, 1);
    const WallNeighbours neighbours = neighboursOf(tube.mesh);
    std::vector<std::uint8_t> known(values.size(), 1);
    const auto smooth = smoothOverWall(tube.mesh, neighbours, values, known, length);
    const double damped = 1 / (1 + length * length * wave * wave);
    for (std::size_t v = 0; v < smooth.size(); ++v) {
        const double z = tube.mesh.places[v].z;
        EXPECT_NEAR(smooth[v].z, 1, 1e-4);
        if (std::abs(z) > 0.025) continue;
        EXPECT_NEAR(smooth[v].y, z, 0.0002);
        EXPECT_NEAR(smooth[v].x, damped * std::cos(wave * z), 0.06);
    }
    // What is not known takes on what is around it.
    const auto unknown = [](const glm::vec3& p) { return p.y > 0.008f && std::abs(p.z) < 0.004f; };
    int patch = 0;
    for (std::size_t v = 0; v < known.size(); ++v)
        if (unknown(tube.mesh.places[v])) known[v] = 0, values[v] = glm::vec3(100), ++patch;
    EXPECT_GT(patch, 50);
    const auto filled = smoothOverWall(tube.mesh, neighbours, values, known, length);
    for (std::size_t v = 0; v < filled.size(); ++v)
        if (std::abs(tube.mesh.places[v].z) < 0.025f) {
            EXPECT_NEAR(filled[v].y, tube.mesh.places[v].z, 0.0015);
        }
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
    const Plane<PackedColor> picture = tube.flat.picture({}, {}), map = tube.flat.distortionMap();
    EXPECT_EQ(picture.width(), tube.flat.width());
    EXPECT_GT(picture.height(), tube.flat.height()) << "the scale";
    const glm::vec3 wall = unpackColor(picture.at(picture.width() / 2, tube.flat.height() / 2));
    EXPECT_GT(wall.x, 0.05f);
    EXPECT_LT(wall.z, 0.95f);
    EXPECT_EQ(map.width(), tube.flat.width());
    // A mark is an outline: it changes pixels around what it holds, none of what it holds.
    const std::uint32_t marked = tube.flat.vertexAt(picture.width() / 2, tube.flat.height() / 2);
    ASSERT_NE(marked, UnfoldedWall::kNone);
    const UnfoldedWall::Mark mark{{&marked, 1}, {0, 0, 1}};
    const Plane<PackedColor> outlined = tube.flat.picture({}, {&mark, 1});
    int changed = 0;
    for (int y = 0; y < tube.flat.height(); ++y)
        for (int x = 0; x < tube.flat.width(); ++x) {
            const bool here = outlined.at(x, y) != picture.at(x, y);
            changed += here;
            EXPECT_FALSE(here && tube.flat.vertexAt(x, y) == marked);
        }
    EXPECT_GT(changed, 3);
    EXPECT_LT(changed, 60);
}

TEST(Unfolding, RefusesWhatHasNoLine) {
    const LumenWall tube([](const glm::dvec3& p) { return toTube(p, 0.008, -0.01, 0.01); },
                         {-0.011, -0.011, -0.013}, {0.011, 0.011, 0.013}, 0.001);
    const WallNeighbours neighbours = neighboursOf(tube.mesh);
    const LineOfSight sight = tube.sight();
    Progress progress;
    Centreline point;
    point.points.resize(1);
    EXPECT_THROW(UnfoldedWall(tube.mesh, neighbours, {}, sight, {}, progress), Error);
    EXPECT_THROW(UnfoldedWall(tube.mesh, neighbours, point, sight, {}, progress), Error);
    const WallMesh none;
    EXPECT_THROW(UnfoldedWall(none, neighboursOf(none), lineThrough({{0, 0, 0}, {0, 0, 0.01}}, 0.008), sight,
                              {}, progress),
                 Error);
}

}  // namespace
}  // namespace stereonav::test
