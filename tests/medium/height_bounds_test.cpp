// Bounds of heights hold what samples of every level find, and a sweep that leaves out by them shows what one
// does that leaves out nothing.
#include "engine/medium/sweep/height_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <string>

#include "engine/medium/sweep/medium_sweep.h"
#include "sweep_scenes.h"

namespace stereonav {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

MediumTable tableOf(double opacity, double thickness) {
    MediumMaterial m;
    m.color = {0.9f, 0.7f, 0.5f};
    m.opacity = opacity;
    m.transport = {0.5f, 0.6f, 0.7f};
    return makeMediumTable(MediumTransfer({{0, m}}, thickness, "test"), 0, 1);
}

// "random", "holes", "flat", "cliffs", "hills".
HeightLayer layerOf(const std::string& kind, int width, int height, double taper = 0) {
    std::mt19937 random(static_cast<unsigned>(width * 131 + height));
    std::uniform_real_distribution<double> u(0, 1);
    HeightLayer layer;
    layer.originX = -0.5 * (width - 1) * 10 + 3;
    layer.originY = -0.5 * (height - 1) * 10;
    layer.spacing = 10;
    layer.below = 25;
    layer.above = 2;
    layer.taper = taper;
    layer.levels.emplace_back(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double h = 40;
            if (kind == "random") h = 100 * u(random);
            if (kind == "holes") h = u(random) < 0.2 ? kNaN : 100 * u(random);
            if (kind == "cliffs") h = x / 7 % 2 == y / 5 % 2 ? 0 : 300;
            if (kind == "hills") h = 60 * std::sin(0.21 * x) * std::cos(0.17 * y) + 5 * u(random);
            layer.levels[0].at(x, y) = static_cast<float>(std::round(4 * h) / 4);  // so that sums are exact
        }
    layer.table = tableOf(0.6, 12);
    makeMipLevels(layer);
    return layer;
}

const char* const kKinds[] = {"random", "holes", "flat", "cliffs", "hills"};

TEST(HeightBounds, HoldWhateverASampleFinds) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(0, 1);
    for (const std::string kind : kKinds)
        for (const auto& [width, height] : {std::pair(33, 21), std::pair(64, 64), std::pair(7, 50),
                                            std::pair(2, 2), std::pair(1, 1), std::pair(1, 9)}) {
            const HeightLayer layer = layerOf(kind, width, height);
            if (!(layer.lowest < layer.highest)) continue;
            const HeightBounds bounds(layer, 0);
            int inside = 0, left = 0;
            for (int n = 0; n < 4000; ++n) {
                const double footprint = n % 5 == 0 ? 0 : 10 * std::exp2(8 * u(random) - 1);
                const glm::dvec3 size =
                    std::exp2(9 * u(random) - 4) * glm::dvec3(u(random), u(random), u(random));
                const glm::dvec3 low =
                    glm::dvec3(layer.originX - 20 + (width * 10 + 40) * u(random),
                               layer.originY - 20 + (height * 10 + 40) * u(random),
                               layer.lowest - 60 + (layer.highest - layer.lowest + 120) * u(random)) -
                    0.5 * size;
                const bool met = bounds.meets(low, low + size, footprint);
                left += !met;
                for (int k = 0; k < 8; ++k) {
                    const glm::dvec3 place = low + size * glm::dvec3(u(random), u(random), u(random));
                    if (!(layer.at(place, footprint * (k % 2 ? 1 : u(random))).extinction > 0)) continue;
                    ++inside;
                    ASSERT_TRUE(met) << kind << ' ' << width << 'x' << height << ' ' << footprint;
                }
            }
            EXPECT_GT(left, 100) << kind << ' ' << width << 'x' << height << ": leaves out nothing";
            if (width > 2) {
                EXPECT_GT(inside, 100) << kind << ' ' << width << 'x' << height;
            }
        }
}

TEST(HeightBounds, AskForEverythingWhereNothingIsKnownOfTheBox) {
    const HeightLayer layer = layerOf("random", 33, 21);
    const HeightBounds bounds(layer, 0);
    const glm::dvec3 nowhere(kNaN);
    EXPECT_TRUE(bounds.meets(nowhere, nowhere, 1));
    EXPECT_TRUE(bounds.meets({-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}, 1));
    for (const double footprint : {kNaN, std::numeric_limits<double>::infinity(), 1e300})
        EXPECT_TRUE(bounds.meets({0, 0, 50}, {1, 1, 51}, footprint));
    EXPECT_FALSE(bounds.meets({0, 0, 1000}, {1, 1, 1001}, kNaN));
    EXPECT_FALSE(bounds.meets({5000, 0, 0}, {5001, 1, 100}, kNaN));
    EXPECT_GT(bounds.heldBytes(), 33u * 21 / 4 * 8);
    EXPECT_LT(bounds.heldBytes(), 33u * 21 * 4);
}

TEST(HeightBounds, AreWidenedByDisplacements) {
    const HeightLayer layer = layerOf("flat", 21, 21);  // 40 m, from 15 m to 42 m
    for (const double moved : {0.0, 7.0}) {
        const HeightBounds bounds(layer, moved);
        EXPECT_TRUE(bounds.meets({0, 0, 42 + moved - 0.1}, {1, 1, 60}, 1));
        EXPECT_FALSE(bounds.meets({0, 0, 42 + moved + 0.1}, {1, 1, 60}, 1));
        EXPECT_TRUE(bounds.meets({0, 0, 0}, {1, 1, 15 - moved + 0.1}, 1));
        EXPECT_FALSE(bounds.meets({0, 0, 0}, {1, 1, 15 - moved - 0.1}, 1));
        EXPECT_FALSE(bounds.meets({103 + moved + 0.3, 0, 20}, {110 + moved, 1, 30}, 1));
        EXPECT_TRUE(bounds.meets({103 + moved - 0.3, 0, 20}, {110 + moved, 1, 30}, 1));
    }
}

// A layer of nothing through the whole box: every tile and slab may hold something then.
HeightLayer nothingThrough(const HeightLayer& whole) {
    HeightLayer layer;
    layer.originX = whole.originX;
    layer.originY = whole.originY;
    layer.spacing = whole.spacing;
    layer.levels.emplace_back(whole.levels[0].width(), whole.levels[0].height());
    for (int y = 0; y < whole.levels[0].height(); ++y)
        for (int x = 0; x < whole.levels[0].width(); ++x)
            layer.levels[0].at(x, y) = static_cast<float>(whole.lowest);
    layer.above = whole.highest - whole.lowest;
    layer.below = 0;
    layer.taper = whole.taper;  // so that eyes share in both or in neither
    layer.table = tableOf(0, 12);
    makeMipLevels(layer);
    return layer;
}

struct Place {
    const char* name;
    glm::dvec3 eye, target;
};

void expectSame(const std::vector<MediumPicture>& a, const std::vector<MediumPicture>& b) {
    for (std::size_t n = 0; n < a.size(); ++n)
        for (int y = 0; y < a[n].light.height(); ++y)
            for (int x = 0; x < a[n].light.width(); ++x) {
                ASSERT_EQ(a[n].light.at(x, y), b[n].light.at(x, y)) << x << ' ' << y;
                ASSERT_EQ(a[n].viewDepth.at(x, y), b[n].viewDepth.at(x, y)) << x << ' ' << y;
            }
}

// Eyes above, in and under the layer, from near and so far that pixels are larger than many samples; suns and
// lamps before and behind them.
TEST(HeightBounds, NothingThatIsSeenIsLeftOut) {
    const Place places[] = {{"above", {0, -300, 200}, {0, 0, 40}},
                            {"inside", {5, 5, 35}, {60, 90, 30}},
                            {"under the ground", {0, 0, -100}, {30, 60, 0}},
                            {"far", {0, -20000, 9000}, {0, 0, 0}},
                            {"straight down", {3, 4, 500}, {3, 4.001, 0}}};
    for (const std::string kind : kKinds)
        for (const double taper : {0.0, 6.0})
            for (const Place& place : places) {
                SCOPED_TRACE(kind + ", " + place.name + ", taper " + std::to_string(taper));
                const HeightLayer layer = layerOf(kind, 41, 37, taper);
                const Medium medium(std::vector<HeightLayer>{layer}), whole({layer, nothingThrough(layer)});
                ASSERT_EQ(medium.bounds().low, whole.bounds().low);
                ASSERT_EQ(medium.bounds().high, whole.bounds().high);
                for (const bool lamp : {false, true}) {
                    MediumLook look;
                    look.model = MediumModel::Indirect;
                    look.light = test::sun(glm::normalize(glm::dvec3(0.5, taper > 0 ? 0.6 : -0.6, -0.5)));
                    if (lamp) {
                        look.light.kind = MediumLight::Kind::Lamp;
                        look.light.position = {-200, -250, 400};
                        look.light.coneAngle = 1.2;
                    }
                    SweepSetting setting;
                    setting.slices = 40;
                    setting.lightSize = 40;
                    const double fov = place.eye.y < -1000 ? 0.03 : 0.8;
                    std::vector<EyeView> eyes(2, test::viewFrom(place.eye, place.target, fov, 34, 26));
                    eyes[1].eye += 6.0 * eyes[1].right;
                    MediumSweep fast(medium), slow(whole);
                    std::vector<MediumPicture> some(2), all(2);
                    const SweepTimings few = fast.render(look, setting, eyes, eyes[0].head, 0, some);
                    const SweepTimings many = slow.render(look, setting, eyes, eyes[0].head, 0, all);
                    expectSame(all, some);
                    EXPECT_LE(few.eyeSamples, many.eyeSamples);
                    if (kind == "hills" && place.name == std::string("above")) {
                        EXPECT_LT(few.eyeSamples, many.eyeSamples);
                    }
                }
            }
}

}  // namespace
}  // namespace stereonav
