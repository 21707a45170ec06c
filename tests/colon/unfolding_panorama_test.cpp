// Panoramas from both ends: folds that hide wall from the one and show it to the other.
#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <vector>

#include "colon/instruments/panorama.h"
#include "engine/base/error.h"
#include "tests/colon/lumen_wall.h"
#include "tests/support/analytic_lumen.h"

namespace stereonav::test {
namespace {

constexpr double kTubeRadius = 0.012, kOpening = 0.005, kFoldHalf = 0.0012;
using End = Panorama::End;

// A tube along z, and one with a ring across its middle that leaves a round opening.
LumenWall tubeWith(bool fold) {
    const Shape shape = [fold](const glm::dvec3& p) {
        const double tube = toTube(p, kTubeRadius, -0.05, 0.05);
        const double ring = std::min(kFoldHalf - std::abs(p.z), std::hypot(p.x, p.y) - kOpening);
        return fold ? std::max(tube, ring) : tube;
    };
    return {shape, {-0.015, -0.015, -0.053}, {0.015, 0.015, 0.053}, 0.0006};
}

Centreline middleLine() {
    return lineThrough({{0, 0, -0.045}, {0, 0, 0.045}}, kTubeRadius);
}

struct Seen {
    LumenWall wall;
    Centreline line = middleLine();
    LineOfSight sight = wall.sight();
    Progress progress;
    Panorama panorama;

    explicit Seen(bool fold, double pixel = 0.001)
        : wall(tubeWith(fold)), panorama(wall.lumen.field, line, sight, pixel, progress) {}
};

glm::dvec3 besideWall(double z, double turn) {
    const double away = kTubeRadius - 0.0008;
    return {away * std::cos(turn), away * std::sin(turn), z};
}

TEST(Panorama, ShowsFromOneEndWhatAFoldHidesFromTheOther) {
    const Seen folded(true), plain(false);
    for (const double turn : {0.3, 1.7, 4.0}) {
        // A place 3 mm behind the fold is seen from 11 mm before it, through 5 mm of opening at best: hidden.
        const glm::dvec3 after = besideWall(0.003, turn), before = besideWall(-0.003, turn);
        EXPECT_FALSE(folded.panorama.shows(End::Rectum, after));
        EXPECT_TRUE(folded.panorama.shows(End::Caecum, after));
        EXPECT_TRUE(folded.panorama.shows(End::Rectum, before));
        EXPECT_FALSE(folded.panorama.shows(End::Caecum, before));
        for (const glm::dvec3& place : {after, before}) {
            EXPECT_TRUE(plain.panorama.shows(End::Rectum, place)) << "without the fold nothing hides it";
            EXPECT_TRUE(plain.panorama.shows(End::Caecum, place));
        }
    }
    EXPECT_FALSE(plain.panorama.shows(End::Rectum, besideWall(-0.042, 0))) << "no eye before the line";
    EXPECT_TRUE(plain.panorama.shows(End::Caecum, besideWall(-0.042, 0)));
    EXPECT_FALSE(plain.panorama.shows(End::Rectum, glm::dvec3(0, 0, 5)));
}

// An eye at the line's beginning sees the part of the tube's side that lies a radius ahead, and so on.
TEST(Panorama, SharesAreThoseOfATube) {
    Seen plain(false), folded(true);
    const Panorama::Shares tube = plain.panorama.shares(plain.wall.mesh, plain.progress);
    const double whole = 2 * kTubeRadius * 0.1 + 2 * kTubeRadius * kTubeRadius;  // over pi
    // From -45 mm + 12 mm on to the far end, and of that end's disc what lies 5 mm and more aside of the
    // axis.
    const double side = 2 * kTubeRadius * (0.05 + 0.045 - kTubeRadius),
                 disc = kTubeRadius * kTubeRadius - 0.005 * 0.005;
    EXPECT_NEAR(tube.rectum, (side + disc) / whole, 0.02);
    EXPECT_NEAR(tube.caecum, tube.rectum, 0.01);
    EXPECT_GT(tube.either, 0.97);
    EXPECT_LE(tube.either, 1 + 1e-9);
    const Panorama::Shares ring = folded.panorama.shares(folded.wall.mesh, folded.progress);
    EXPECT_LT(ring.rectum, tube.rectum - 0.05);
    EXPECT_GT(ring.either, ring.rectum + 0.1);
    EXPECT_LT(ring.either, 1);
}

TEST(Panorama, IsTwoStripsOfTheLine) {
    Seen plain(false);
    const int width = plain.panorama.width(), height = plain.panorama.height();
    EXPECT_NEAR(width, 91, 1);
    EXPECT_NEAR(height, 2 * std::numbers::pi * kTubeRadius / 0.001, 2);
    VolumeLook look;
    const Plane<PackedColor> picture = plain.panorama.picture(look, plain.progress);
    ASSERT_EQ(picture.width(), width);
    ASSERT_GT(picture.height(), 2 * height);
    const PackedColor white = packColor(glm::vec3(1));
    const int upper = height / 2, lower = picture.height() - 1 - height / 2;
    EXPECT_EQ(picture.at(5, upper), white) << "no eye that looks ahead sees the rectum's end";
    EXPECT_NE(picture.at(5, lower), white);
    EXPECT_NE(picture.at(width - 6, upper), white);
    EXPECT_EQ(picture.at(width - 6, lower), white);
    // A wall as far everywhere is as bright everywhere, from both ends.
    EXPECT_NE(picture.at(width / 2, upper), white);
    const Plane<PackedColor> again = plain.panorama.picture(look, plain.progress);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < width; ++x) ASSERT_EQ(picture.at(x, y), again.at(x, y));
}

TEST(Panorama, TellsWhatAPixelShowsAndWhereAPlaceLies) {
    Seen plain(false);
    const Seen folded(true);
    const int width = plain.panorama.width(), height = plain.panorama.height(), rows = plain.panorama.rows();
    std::vector<std::optional<Panorama::Place>> shown(static_cast<std::size_t>(width) * rows);
    const auto shownAt = [&](int x, int y) -> auto& {
        return shown[static_cast<std::size_t>(y) * width + x];
    };
    plain.panorama.picture(VolumeLook(), plain.progress, [&](int x, int y, const Panorama::Place& place) {
        EXPECT_FALSE(shownAt(x, y)) << "told twice";
        shownAt(x, y) = place;
    });
    int places = 0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < width; x += 7) {
            const auto& there = shownAt(x, y);
            const bool upper = y < height, lower = y >= rows - height;
            if (!there) {
                EXPECT_TRUE(!(upper || lower) || (upper ? x < 14 : x > width - 15)) << x << " " << y;
                continue;
            }
            ++places;
            EXPECT_NEAR(std::hypot(there->wall.x, there->wall.y), kTubeRadius, 0.0004);
            // 45 degrees off the line, ahead or back: in the column of its place on the line.
            const double ahead = there->wall.z - there->eye.z;
            EXPECT_NEAR(std::abs(ahead), kTubeRadius, 0.0005);
            EXPECT_EQ(ahead > 0, upper);
            EXPECT_NEAR(there->wall.z, -0.045 + 0.001 * x, 0.0006);
            const glm::dvec3 before = there->wall + 0.03 * (there->eye - there->wall);
            const auto pixel = plain.panorama.pixelsOf(before)[upper ? 0 : 1];
            ASSERT_TRUE(pixel) << x << " " << y;
            EXPECT_NEAR(pixel->x, x + 0.5, 0.05);
            EXPECT_NEAR(pixel->y, y + 0.5, 0.05);
        }
    EXPECT_GT(places, 1500);
    for (const int y : {height, rows - height - 1}) EXPECT_FALSE(shownAt(40, y)) << y;
    // What a fold hides from the one end lies in the other strip alone.
    const auto hidden = folded.panorama.pixelsOf(besideWall(0.003, 1.7));
    EXPECT_FALSE(hidden[0]);
    ASSERT_TRUE(hidden[1]);
    EXPECT_GT(hidden[1]->y, height);
    const auto far = plain.panorama.pixelsOf({0, 0, 5});
    EXPECT_FALSE(far[0] || far[1]);
    const auto none = plain.panorama.pixelsOf(glm::dvec3(std::nan(""), 0, 0));
    EXPECT_FALSE(none[0] || none[1]);
}

TEST(Panorama, RefusesWhatIsTooLarge) {
    EXPECT_THROW(Seen(false, 1e-6), Error);
    Seen small(false, 0.02);
    EXPECT_GE(small.panorama.width(), 4);
    EXPECT_GE(small.panorama.height(), 3);
}

}  // namespace
}  // namespace stereonav::test
