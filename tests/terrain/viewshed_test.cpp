// Who sees whom: closed forms, and every sample of small grounds against a line that is looked at in very
// many places.
#include "terrain/survey/viewshed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

Heightfield sightGround(int width, int height, glm::dvec2 spacing,
                        const std::function<double(int, int)>& heightAt) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(static_cast<float>(heightAt(i, j)));
    return Heightfield(width, height, spacing, std::move(heights), "test");
}

bool seenAt(const Viewshed& shed, int i, int j) {
    return shed.seen.row(j)[i] == static_cast<std::uint8_t>(Seen::Visible);
}

// How far the line passes above the ground where it is nearest, by steps along it. Steps of a part in 4000 of
// at most 40 samples: what lies between is less than `slack` lower.
double leastRoom(const Heightfield& ground, const ViewshedSetting& setting, int i, int j) {
    const glm::dvec2 eye = ground.worldFromGrid(setting.eye), target = ground.worldFromGrid({i, j});
    const double from = ground.heightAt(eye) + setting.eyeHeight;
    const double to = ground.sample(i, j) + setting.targetHeight;
    const glm::dvec2 run = target - eye;
    const double bulge = setting.fall * (run.x * run.x + run.y * run.y);
    double least = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 4000;
    for (int k = 0; k <= kSteps; ++k) {
        const double s = k / double(kSteps);
        const double ground_m = ground.heightAt(eye + s * run) + bulge * s * (1 - s);
        if (std::isfinite(ground_m)) least = std::min(least, from + s * (to - from) - ground_m);
    }
    return least;
}

void expectAsStepped(const Heightfield& ground, const ViewshedSetting& setting) {
    Progress progress;
    const Viewshed shed = viewshedOf(ground, setting, progress);
    constexpr double kSlack = 0.004;  // metres: where steps can not tell
    int told = 0, seen = 0;
    for (int j = 0; j < ground.height(); ++j)
        for (int i = 0; i < ground.width(); ++i) {
            if (!std::isfinite(ground.sample(i, j))) {
                ASSERT_EQ(shed.seen.row(j)[i], static_cast<std::uint8_t>(Seen::NoGround));
                continue;
            }
            const double room = leastRoom(ground, setting, i, j);
            seen += seenAt(shed, i, j);
            // Between two steps the ground may rise over the line; it does not sink from above it.
            if (room < -1e-6) {
                ASSERT_FALSE(seenAt(shed, i, j)) << i << " " << j << " " << room;
                ++told;
            } else if (room > kSlack || (setting.targetHeight == 0 && room > -1e-9)) {
                if (room > kSlack) {
                    ASSERT_TRUE(seenAt(shed, i, j)) << i << " " << j << " " << room;
                    ++told;
                }
            }
        }
    EXPECT_EQ(seen, shed.visible);
    EXPECT_GT(told, ground.width() * ground.height() / 2);
}

Heightfield roughGround(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> rough(0, 6);
    return sightGround(width, height, {10, 14}, [&](int i, int j) {
        return 30 * std::sin(0.21 * i + seed) * std::cos(0.17 * j) + rough(random);
    });
}

TEST(Viewshed, APlaneIsSeenWhole) {
    for (const double eyeHeight : {0.0, 1.7, 300.0}) {
        const Heightfield ground =
            sightGround(61, 47, {30, 25}, [](int i, int j) { return 4.0 * i - 7.0 * j + 100; });
        ViewshedSetting setting;
        setting.eye = {22, 31};
        setting.eyeHeight = eyeHeight;
        Progress progress;
        const Viewshed shed = viewshedOf(ground, setting, progress);
        EXPECT_EQ(shed.visible, 61 * 47) << eyeHeight;
        EXPECT_EQ(shed.samples, 61 * 47);
    }
}

// A wall of height w, d before the eye, hides from an eye at height e < w what lies lower than
// e + (w - e) * x / d.
TEST(Viewshed, AWallHidesWhatLiesInItsShadow) {
    constexpr int kWall = 40;
    constexpr double kTall = 50, kEye = 20;
    const Heightfield ground =
        sightGround(121, 3, {10, 10}, [](int i, int) { return i == kWall ? kTall : 0.0; });
    for (const double target : {0.0, 79.9, 80.1, 200.0}) {
        ViewshedSetting setting;
        setting.eye = {20, 1};
        setting.eyeHeight = kEye;
        setting.targetHeight = target;
        Progress progress;
        const Viewshed shed = viewshedOf(ground, setting, progress);
        for (int i = 0; i < 121; ++i) {
            const double line = kEye + (kTall - kEye) * (i - 20) / 20.0;  // at i = 60: 80 m
            const bool behind = i > kWall;
            ASSERT_EQ(seenAt(shed, i, 1), !behind || target >= line) << i << " " << target;
        }
    }
}

// Over a sphere an eye h above the sea sees its surface as far as sqrt(2 R h / (1 - k)).
TEST(Viewshed, TheSeaEndsAtTheHorizon) {
    const Heightfield ground = sightGround(401, 3, {200, 200}, [](int, int) { return 0.0; });
    for (const double refraction : {0.0, kUsualRefraction, 0.5})
        for (const double eyeHeight : {2.0, 30.0, 100.0}) {
            ViewshedSetting setting;
            setting.eye = {0, 1};
            setting.eyeHeight = eyeHeight;
            setting.fall = curvatureFall(refraction);
            Progress progress;
            const Viewshed shed = viewshedOf(ground, setting, progress);
            const double horizon = std::sqrt(2 * kEarthRadius * eyeHeight / (1 - refraction));
            for (int i = 1; i < 401; ++i)
                ASSERT_EQ(seenAt(shed, i, 1), 200.0 * i <= horizon) << i << " " << refraction;
        }
}

TEST(Viewshed, TwoPlacesSeeEachOther) {
    const Heightfield ground = roughGround(60, 50, 3);
    const HeightPyramid maxima(ground);
    const SightLines lines(ground, maxima, curvatureFall(0.13));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> x(0, 59), y(0, 49), up(0, 25);
    int seen = 0;
    for (int k = 0; k < 3000; ++k) {
        glm::dvec3 a(x(random), y(random), 0), b(x(random), y(random), 0);
        for (glm::dvec3* p : {&a, &b})
            p->z = ground.heightAt(ground.worldFromGrid(glm::dvec2(*p))) + up(random);
        const Sight there = lines.measure(a, b), back = lines.measure(b, a);
        ASSERT_EQ(lines.sees(a, b), lines.sees(b, a)) << k;
        ASSERT_EQ(there.seen, lines.sees(a, b)) << k;
        ASSERT_NEAR(there.clearance, back.clearance, 1e-9) << k;
        seen += there.seen;
    }
    EXPECT_GT(seen, 300);
    EXPECT_LT(seen, 2700);
}

// In a cell whose corners are 0, 0, 0 and 4c the surface along the diagonal is a parabola.
TEST(Viewshed, TheBulgeOfACellIsFound) {
    const Heightfield ground =
        sightGround(2, 2, {1, 1}, [](int i, int j) { return (i + j) % 2 == 1 ? 1.0 : 0.0; });
    const HeightPyramid maxima(ground);
    const SightLines lines(ground, maxima, 0);
    // Along the diagonal from (0, 0) to (1, 1): 2 s (1 - s), at most a half.
    const Sight sight = lines.measure({0, 0, 0.4}, {1, 1, 0.4});
    EXPECT_FALSE(sight.seen);
    EXPECT_NEAR(sight.clearance, -0.1, 1e-12);
    EXPECT_NEAR(sight.at, std::sqrt(0.5), 1e-9);
    EXPECT_TRUE(lines.sees({0, 0, 0.51}, {1, 1, 0.51}));
    EXPECT_FALSE(lines.sees({0, 0, 0.49}, {1, 1, 0.49}));
}

// Over a peak halfway, on ground whose samples are farther apart one way: distances are metres over the plan.
TEST(Viewshed, ALineIsMeasuredInMetresWhateverItsDirection) {
    for (const glm::dvec2& spacing : {glm::dvec2(30, 20), {20, 30}}) {
        const Heightfield ground =
            sightGround(41, 21, spacing, [](int i, int j) { return i == 20 && j == 8 ? 70.0 : 0.0; });
        const HeightPyramid maxima(ground);
        const double way = glm::length(glm::dvec2(32, 12) * spacing), fall = 1e-4;
        for (const double round : {0.0, fall}) {
            const SightLines lines(ground, maxima, round);
            // From (4, 2) to (36, 14): 50 m high in the middle, where the ground is lifted by fall * (way /
            // 2)^2.
            const Sight sight = lines.measure({4, 2, 40}, {36, 14, 60});
            EXPECT_NEAR(sight.clearance, 50 - 70 - round * way * way / 4, 1e-9) << spacing.x;
            EXPECT_NEAR(sight.at, way / 2, 1e-9) << spacing.x;
            EXPECT_FALSE(sight.seen);
        }
    }
}

TEST(Viewshed, RoughGroundAsSteppedAlongEachLine) {
    ViewshedSetting setting;
    setting.eye = {13, 20};
    for (const double eyeHeight : {0.5, 12.0}) {
        setting.eyeHeight = eyeHeight;
        expectAsStepped(roughGround(40, 33, 1), setting);
    }
    setting.eye = {26.37, 8.91};  // between samples
    setting.targetHeight = 2;
    expectAsStepped(roughGround(40, 33, 2), setting);
    setting.fall = 2e-4;  // a small planet
    expectAsStepped(roughGround(33, 40, 4), setting);
    setting.eye = {39, 0};  // a corner
    expectAsStepped(roughGround(40, 33, 6), setting);
}

TEST(Viewshed, HolesHideNothing) {
    const double nan = std::nan("");
    std::mt19937 random(9);
    std::uniform_real_distribution<double> any(0, 1);
    const Heightfield ground = sightGround(36, 30, {10, 10}, [&](int i, int j) {
        return any(random) < 0.08 ? nan : 12 * std::sin(0.4 * i) * std::cos(0.3 * j);
    });
    ViewshedSetting setting;
    for (const glm::dvec2 eye : {glm::dvec2(17, 12), glm::dvec2(5.5, 22.25), glm::dvec2(30.1, 3.7)}) {
        setting.eye = eye;
        setting.eyeHeight = 6;
        if (std::isfinite(ground.heightAt(ground.worldFromGrid(eye)))) expectAsStepped(ground, setting);
    }
}

// Most samples are told by bounds: the walk of each must say the same.
TEST(Viewshed, BoundsSayWhatEachLineSays) {
    for (const unsigned seed : {11u, 12u}) {
        const Heightfield ground = roughGround(190, 140, seed);
        const HeightPyramid maxima(ground);
        for (const double fall : {0.0, curvatureFall(0.13), 1e-5})
            for (const glm::dvec2 eye :
                 {glm::dvec2(95, 70), glm::dvec2(0, 139), glm::dvec2(44.499, 100.001)}) {
                ViewshedSetting setting;
                setting.eye = eye, setting.eyeHeight = 15, setting.fall = fall;
                const SightLines lines(ground, maxima, fall);
                const glm::dvec3 from(eye, ground.heightAt(ground.worldFromGrid(eye)) + 15);
                Progress progress;
                const Viewshed shed = viewshedOf(ground, setting, progress);
                EXPECT_LT(shed.walkedAll, shed.samples);
                for (int j = 0; j < ground.height(); ++j)
                    for (int i = 0; i < ground.width(); ++i)
                        ASSERT_EQ(seenAt(shed, i, j), lines.sees(from, {i, j, ground.sample(i, j)}))
                            << i << " " << j;
            }
    }
}

// Lines from a sample go through corners, and along borders, of cells that are not known.
TEST(Viewshed, BoundsSayWhatEachLineSaysAmongHoles) {
    std::mt19937 random(31);
    std::uniform_real_distribution<double> any(0, 1);
    const Heightfield ground = sightGround(131, 118, {10, 14}, [&](int i, int j) {
        const bool hole = any(random) < 0.06 || std::hypot(i - 90, j - 60) < 15;
        return hole ? std::nan("") : 25 * std::sin(0.11 * i) * std::cos(0.13 * j) + 5 * any(random);
    });
    const HeightPyramid maxima(ground);
    const SightLines lines(ground, maxima, 0);
    int told = 0;
    for (const glm::dvec2 eye : {glm::dvec2(60, 50), glm::dvec2(31, 100), glm::dvec2(120, 9)}) {
        const double height = ground.heightAt(ground.worldFromGrid(eye));
        if (!std::isfinite(height)) continue;
        ViewshedSetting setting;
        setting.eye = eye, setting.eyeHeight = 12;
        Progress progress;
        const Viewshed shed = viewshedOf(ground, setting, progress);
        for (int j = 0; j < ground.height(); ++j)
            for (int i = 0; i < ground.width(); ++i) {
                if (!std::isfinite(ground.sample(i, j))) continue;
                ASSERT_EQ(seenAt(shed, i, j), lines.sees({eye, height + 12}, {i, j, ground.sample(i, j)}))
                    << i << " " << j;
                ++told;
            }
    }
    EXPECT_GT(told, 12000);
}

void expectAsEachLine(const Heightfield& ground, const ViewshedSetting& setting) {
    const HeightPyramid maxima(ground);
    const SightLines lines(ground, maxima, setting.fall);
    const glm::dvec3 from(setting.eye,
                          ground.heightAt(ground.worldFromGrid(setting.eye)) + setting.eyeHeight);
    Progress progress;
    const Viewshed shed = viewshedOf(ground, setting, progress);
    for (int j = 0; j < ground.height(); ++j)
        for (int i = 0; i < ground.width(); ++i) {
            const double target = ground.sample(i, j) + setting.targetHeight;
            if (!std::isfinite(target)) continue;
            ASSERT_EQ(seenAt(shed, i, j), lines.sees(from, {i, j, target})) << i << " " << j;
        }
}

// Fields of equal heights, ground that slopes with the line, peaks far above and below the eye: lines that
// graze, where floats alone would not tell.
TEST(Viewshed, GroundThatLinesGrazeIsAsEachLineSays) {
    const std::vector<std::function<double(int, int)>> grounds = {
        [](int, int) { return 812.0; },
        [](int i, int j) { return std::floor(0.013 * i * i - 0.2 * j); },
        [](int i, int j) { return (i / 9 + j / 7) % 2 * 0.001 + 4000; },
        [](int i, int j) { return 0.1f * static_cast<float>(i) + 0.3f * static_cast<float>(j); },
        [](int i, int j) { return (i * 37 + j * 101) % 17 == 0 ? 8000.0 : -400.0; },
        [](int i, int j) { return 1e6 + (i ^ j) % 5; }};
    for (const auto& heightAt : grounds) {
        const Heightfield ground = sightGround(77, 90, {30, 20}, heightAt);
        for (const glm::dvec2 eye : {glm::dvec2(38, 41), glm::dvec2(0.25, 3.5), glm::dvec2(76, 89)})
            for (const double eyeHeight : {0.0, 1e-4, 25.0}) {
                ViewshedSetting setting;
                setting.eye = eye, setting.eyeHeight = eyeHeight;
                expectAsEachLine(ground, setting);
                setting.targetHeight = 1.5, setting.fall = 1e-6;
                expectAsEachLine(ground, setting);
            }
    }
}

// Lines that leave along a row or a diagonal run between cells of which one is open.
TEST(Viewshed, LinesBetweenOpenCellsAreAsEachLineSays) {
    std::mt19937 random(77);
    for (const double share : {0.003, 0.05, 0.4}) {
        std::uniform_real_distribution<double> any(0, 1);
        const Heightfield ground = sightGround(70, 64, {10, 10}, [&](int i, int j) {
            const bool near = std::abs(i - 30) < 3 && std::abs(j - 30) < 3;
            const double height = std::floor(3 * any(random));
            return !near && any(random) < share ? std::nan("") : height;
        });
        for (const glm::dvec2 eye : {glm::dvec2(30, 30), glm::dvec2(29.5, 31), glm::dvec2(31, 28.75)}) {
            ViewshedSetting setting;
            setting.eye = eye, setting.eyeHeight = 2.5;
            expectAsEachLine(ground, setting);
        }
    }
}

// Grounds of few columns and rows, longer one way.
TEST(Viewshed, SmallGroundIsAsEachLineSays) {
    for (const glm::ivec2 size :
         {glm::ivec2(2, 2), glm::ivec2(3, 41), glm::ivec2(300, 2), glm::ivec2(7, 5)}) {
        const Heightfield ground = roughGround(size.x, size.y, 8);
        for (const glm::dvec2 share : {glm::dvec2(0), glm::dvec2(1), glm::dvec2(0.37, 0.61)}) {
            ViewshedSetting setting;
            setting.eye = share * glm::dvec2(size - 1);
            expectAsEachLine(ground, setting);
        }
    }
}

TEST(Viewshed, ThreadsAndReachChangeNothingElse) {
    const Heightfield ground = roughGround(150, 120, 21);
    ViewshedSetting setting;
    setting.eye = {80.3, 41.8};
    setting.eyeHeight = 10;
    Progress progress;
    const int before = threadCount();
    setThreadCount(1);
    const Viewshed one = viewshedOf(ground, setting, progress);
    setThreadCount(3);
    const Viewshed three = viewshedOf(ground, setting, progress);
    setting.reach = 500;
    const Viewshed near = viewshedOf(ground, setting, progress);
    setThreadCount(before);
    EXPECT_EQ(one.visible, three.visible);
    EXPECT_LT(near.samples, one.samples);
    for (int j = 0; j < ground.height(); ++j)
        for (int i = 0; i < ground.width(); ++i) {
            ASSERT_EQ(seenAt(one, i, j), seenAt(three, i, j));
            const double distance = std::hypot((i - 80.3) * 10, (j - 41.8) * 14);
            ASSERT_EQ(seenAt(near, i, j), seenAt(one, i, j) && distance <= 500) << i << " " << j;
        }
}

// Samples within reach are those of an ellipse, on wide and on tall ground.
TEST(Viewshed, CountsTheSamplesWithinReach) {
    for (const glm::ivec2& size : {glm::ivec2(90, 40), {40, 90}}) {
        const Heightfield ground = sightGround(size.x, size.y, {10, 14}, [&](int i, int j) {
            return i == size.x - 2 && j == size.y - 2 ? std::nan("") : 5.0;
        });
        ViewshedSetting setting;
        setting.eye = glm::dvec2(size) - 9.5;
        setting.reach = 175;
        Progress progress;
        const Viewshed shed = viewshedOf(ground, setting, progress);
        int within = 0;
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                within += std::hypot((i - setting.eye.x) * 10, (j - setting.eye.y) * 14) <= 175 &&
                          std::isfinite(ground.sample(i, j));
        EXPECT_EQ(shed.samples, within) << size.x;
        EXPECT_EQ(shed.visible, within) << "of level ground all";
    }
}

TEST(Viewshed, APlaceOffTheGroundIsRefused) {
    const Heightfield ground = roughGround(20, 30, 1);
    Progress progress;
    for (const glm::dvec2 eye :
         {glm::dvec2(-0.01, 3), glm::dvec2(3, 29.01), glm::dvec2(19.01, 3), glm::dvec2(3, -0.01),
          glm::dvec2(25, 3), glm::dvec2(std::nan(""), 3), glm::dvec2(3, std::nan(""))}) {
        ViewshedSetting setting;
        setting.eye = eye;
        EXPECT_THROW(viewshedOf(ground, setting, progress), Error);
    }
}

}  // namespace
}  // namespace stereonav
