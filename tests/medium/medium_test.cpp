// A medium's properties, gradients, bounds and largest extinction, for grids and for layers; built-in fields.
#include "engine/medium/model/medium.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/medium/model/built_in_media.h"
#include "engine/medium/model/medium_look.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

MediumMaterial material(double opacity, const glm::vec3& color = glm::vec3(1.0f)) {
    MediumMaterial m;
    m.opacity = opacity;
    m.color = color;
    return m;
}

// A turned grid with a linear ramp in world space, in metres times `slope`.
std::shared_ptr<GreyVolume> rampField(const glm::dvec3& slope) {
    VolumeFrame frame;
    frame.size = {12, 9, 14};
    frame.spacing = {0.001, 0.002, 0.0015};
    frame.origin = {0.3, -0.2, 0.1};
    const double c = 0.6, s = 0.8;
    frame.axes = glm::dmat3(glm::dvec3(c, s, 0), glm::dvec3(-s, c, 0), glm::dvec3(0, 0, 1));
    auto field = std::make_shared<GreyVolume>(frame);
    field->scale = 0.5;
    field->offset = -100;
    for (int k = 0; k < 14; ++k)
        for (int j = 0; j < 9; ++j)
            for (int i = 0; i < 12; ++i) {
                const glm::dvec3 world = frame.worldFromVoxel({i, j, k}) - frame.origin;
                field->at(i, j, k) =
                    static_cast<std::int16_t>(std::lround((glm::dot(world, slope) + 200) / 0.5));
            }
    return field;
}

const MediumTransfer kRamp(
    {{50, material(0)}, {100, material(0.5, {1, 0, 0})}, {200, material(0.9, {0, 1, 0})}}, 0.001, "test");

TEST(Medium, EmptySpaceIsEmpty) {
    const Medium none;
    EXPECT_EQ(none.at({0, 0, 0}).extinction, 0.0f);
    EXPECT_EQ(none.gradientAt({0, 0, 0}), glm::dvec3(0.0));
    EXPECT_TRUE(none.bounds().empty());
    EXPECT_EQ(none.largestExtinction(), 0);
    EXPECT_TRUE(Medium(nullptr, kRamp).bounds().empty());
    const Medium transparent(rampField({1e4, 0, 0}), MediumTransfer());
    EXPECT_TRUE(transparent.bounds().empty());
    EXPECT_EQ(transparent.largestExtinction(), 0);
    EXPECT_TRUE(Medium(std::vector<HeightLayer>{}).bounds().empty());
    EXPECT_TRUE(Medium(std::vector<HeightLayer>(2)).bounds().empty());
}

TEST(Medium, ReadsTheGridTrilinearly) {
    const glm::dvec3 slope(5000, -2000, 3000);
    const Medium medium(rampField(slope), kRamp);
    const VolumeFrame& frame = medium.field()->frame;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int n = 0; n < 500; ++n) {
        const glm::dvec3 voxel =
            glm::dvec3(11, 8, 13) * glm::dvec3(uniform(random), uniform(random), uniform(random));
        const glm::dvec3 world = frame.worldFromVoxel(voxel);
        const double value = 100 + glm::dot(world - frame.origin, slope);
        const float truth = kRamp.at(value, 0).extinction;
        // Stored values are rounded to 0.5: half of that, times the steepest slope of the function.
        EXPECT_NEAR(medium.at(world).extinction, truth, 0.26 * std::log(5.0) / 0.001 / 50) << n;
        EXPECT_LE(medium.at(world).extinction, medium.largestExtinction()) << n;
    }
    for (const glm::dvec3& outside :
         {glm::dvec3(-0.01, 3, 3), glm::dvec3(3, 8.01, 3), glm::dvec3(3, 3, 13.5)})
        EXPECT_EQ(medium.at(frame.worldFromVoxel(outside)).extinction, 0.0f);
    EXPECT_EQ(medium.at(glm::dvec3(std::nan(""))).extinction, 0.0f);
}

TEST(Medium, GradientIsOfTheWorld) {
    const glm::dvec3 slope(5000, -2000, 3000);
    const Medium medium(rampField(slope), kRamp);
    const VolumeFrame& frame = medium.field()->frame;
    for (double t = 1; t <= 7; t += 0.37) {
        const glm::dvec3 gradient = medium.gradientAt(frame.worldFromVoxel({t, t, t}));
        EXPECT_LT(glm::length(gradient - slope), 350) << t;  // values rounded to 0.5 over 2 mm
    }
    EXPECT_EQ(medium.gradientAt(frame.worldFromVoxel({-1, 3, 3})), glm::dvec3(0.0));
    // At a face one neighbour is the voxel itself.
    const glm::dvec3 atFace = medium.gradientAt(frame.worldFromVoxel({1e-6, 4, 7}));
    EXPECT_NEAR(glm::dot(atFace, frame.axes[0]), glm::dot(slope, frame.axes[0]) / 2, 200);
    EXPECT_NEAR(glm::dot(atFace, frame.axes[2]), glm::dot(slope, frame.axes[2]), 350);
}

TEST(Medium, TwoDimensionsReadTheGradient) {
    MediumRegion flat{{0, 1, 900, 901}, {0, 0, 1000, 2000}, material(0.25)};
    MediumRegion steep{{0, 1, 900, 901}, {1000, 2000, 1e5, 1e6}, material(0.75)};
    const MediumTransfer transfer({flat, steep}, 0.001, "test");
    const auto extinction = [&](double slope) {
        const Medium medium(rampField({0, 0, slope}), transfer);
        return medium.at(medium.field()->frame.worldFromVoxel({5, 4, 7})).extinction;
    };
    EXPECT_NEAR(extinction(0), -std::log(0.75) / 0.001, 1);
    // 64 rows up to 1e6: the first one at 15625 is in the steep region already, halfway to it half of it.
    EXPECT_NEAR(extinction(20000), -std::log(0.25) / 0.001, 5);
}

// Everything not empty is inside the bounds, at any displacement; and they are not much too large.
TEST(Medium, BoundsHoldEverything) {
    auto field = rampField({0, 0, 0});
    for (int k = 4; k <= 7; ++k)
        for (int j = 3; j <= 5; ++j) field->at(6, j, k) = 800;
    Perturbation p;
    p.scales.resize(1);
    p.scales[0].size = 0.01;
    const MediumTransfer visible({{150, material(0)}, {160, material(0.5)}}, 0.001, "test");
    for (const double displacement : {0.0, 0.002}) {
        p.scales[0].displacement = displacement;
        p.scales[0].extinction = 0.5f;
        const Medium medium(field, visible, p);
        const WorldBox box = medium.bounds();
        ASSERT_FALSE(box.empty());
        WorldBox seen{glm::dvec3(1e9), glm::dvec3(-1e9)};
        const glm::dvec3 from = field->frame.worldFromVoxel({-9, -5, -5}) - 0.01;
        for (int k = 0; k < 70; ++k)
            for (int j = 0; j < 70; ++j)
                for (int i = 0; i < 70; ++i) {
                    const glm::dvec3 world = from + glm::dvec3(i, j, k) * 0.0006;
                    const float extinction = medium.at(world).extinction;
                    ASSERT_LE(extinction, medium.largestExtinction());
                    if (!(extinction > 0)) continue;
                    seen.low = glm::min(seen.low, world);
                    seen.high = glm::max(seen.high, world);
                }
        for (int a = 0; a < 3; ++a) {
            EXPECT_LE(box.low[a], seen.low[a]) << a;
            EXPECT_GE(box.high[a], seen.high[a]) << a;
            EXPECT_GE(box.low[a], seen.low[a] - 0.003 - 2 * displacement) << a;
            EXPECT_LE(box.high[a], seen.high[a] + 0.003 + 2 * displacement) << a;
        }
    }
}

TEST(Medium, NoiseMovesThePlaceAndThenTheProperties) {
    Perturbation p = cloudPerturbation();
    const auto field = makeCloudField();
    const MediumTransfer transfer = findMediumTransfer("cloud");
    const Medium plain(field, transfer), moved(field, transfer, p);
    for (double x = -700; x < 700; x += 61)
        for (const double time : {0.0, 1e5}) {
            const glm::dvec3 world(x, 0.3 * x, 900 + 0.2 * x);
            OpticalProperties truth = plain.at(world + displacementAt(p, *moved.noise(), world, time));
            perturb(p, *moved.noise(), world, time, truth);
            EXPECT_EQ(moved.at(world, time).extinction, truth.extinction) << x;
            EXPECT_EQ(moved.at(world, time).indirectExtinction, truth.indirectExtinction) << x;
        }
    EXPECT_EQ(plain.noise(), nullptr);
    EXPECT_NEAR(moved.largestExtinction(), plain.largestExtinction() * p.largestExtinctionFactor(), 1e-9);
    p.scales.resize(5);
    EXPECT_ANY_THROW(Medium(field, transfer, p));
}

HeightLayer layerAt(double height, double opacity, const glm::vec3& color) {
    HeightLayer layer;
    layer.levels.emplace_back(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) layer.levels[0].at(x, y) = static_cast<float>(height + 0.75 * x);
    layer.below = 2;
    layer.above = 1;
    layer.table = makeMediumTable(MediumTransfer({{0, material(opacity, color)}}, 1, "test"), 0, 100);
    makeMipLevels(layer);
    return layer;
}

TEST(Medium, LayersAddUpByExtinction) {
    const Medium medium({layerAt(10, 0.5, {1, 0, 0}), layerAt(12, 0.75, {0, 1, 0})});
    const double red = -std::log(0.5), green = -std::log(0.25);
    const auto at = [&](double z) { return medium.at({0, 3, z}); };
    EXPECT_EQ(at(7.9).extinction, 0.0f);
    EXPECT_NEAR(at(8.1).extinction, red, 1e-6);
    EXPECT_NEAR(at(10.5).extinction, red + green, 1e-6);
    EXPECT_NEAR(at(10.5).color.x, red / (red + green), 1e-6);
    EXPECT_NEAR(at(12.9).extinction, green, 1e-6);
    EXPECT_EQ(at(13.1).extinction, 0.0f);
    EXPECT_NEAR(medium.largestExtinction(), red + green, 1e-6);
    EXPECT_EQ(medium.bounds().low, glm::dvec3(0, 0, 8));
    EXPECT_EQ(medium.bounds().high, glm::dvec3(7, 7, 12 + 5.25 + 1));
}

TEST(Medium, RefusesLayersWithoutAThickness) {
    const auto error = [](const HeightLayer& layer) -> std::string {
        try {
            Medium({HeightLayer(), layer});
        } catch (const Error& e) {
            return e.what();
        }
        return "no error";
    };
    const double nan = std::nan("");
    HeightLayer good = layerAt(10, 0.5, {1, 0, 0});
    good.above = 5;
    good.below = -2;  // mist that begins 2 m above the ground
    makeMipLevels(good);
    EXPECT_EQ(error(good), "no error");
    EXPECT_EQ(Medium({good}).at({0, 3, 11}).extinction, 0.0f);
    EXPECT_GT(Medium({good}).at({0, 3, 13}).extinction, 0.0f);
    for (const double above : {2.0, 1.0, nan}) {
        HeightLayer bad = good;
        bad.above = above;
        EXPECT_THAT(error(bad), HasSubstr("medium:layer 2: expected a layer with a thickness")) << above;
    }
    for (const double wrong : {-1.0, nan}) {
        HeightLayer bad = good;
        bad.taper = wrong;
        EXPECT_THAT(error(bad), HasSubstr("expected a taper of 0 m or more")) << wrong;
        bad = good;
        bad.spacing = wrong;
        EXPECT_THAT(error(bad), HasSubstr("above 0 m apart")) << wrong;
    }
}

TEST(Medium, LayersHaveTheNormalOfTheNearest) {
    const Medium medium({layerAt(10, 0.5, {1, 0, 0}), layerAt(20, 0.75, {0, 1, 0})});
    const glm::dvec3 normal = medium.gradientAt({3.3, 4.4, 12});
    EXPECT_NEAR(glm::length(normal - glm::dvec3(-0.6, 0, 0.8)), 0, 1e-6);
    EXPECT_EQ(medium.gradientAt({-1, 4, 12}), glm::dvec3(0.0));
    EXPECT_EQ(medium.gradientAt({3, 0, 12}).z > 0, true);  // the edge: slopes that are not known are 0
}

TEST(Medium, BuiltInFieldsAreTheSameEverywhere) {
    const auto hash = [](const GreyVolume& field) {
        return Hash().add(field.values.data(), field.values.size() * sizeof(std::int16_t)).value();
    };
    const auto cloud = makeCloudField(), wax = makeWaxField();
    EXPECT_EQ(cloud->frame.size, glm::ivec3(64));
    EXPECT_NEAR(cloud->frame.spacing.x * 64, 2000, 1e-9);
    EXPECT_EQ(wax->frame.size, glm::ivec3(96));
    EXPECT_NEAR(wax->frame.spacing.x * 96, 0.08, 1e-12);
    EXPECT_EQ(hash(*cloud), 16640706032693199129ull);
    EXPECT_EQ(hash(*wax), 3991556390756230477ull);
    const auto rabbit = makeWaxRabbit();
    EXPECT_EQ(rabbit->frame.size, glm::ivec3(128));
    EXPECT_NEAR(rabbit->frame.spacing.x * 128, 0.08, 1e-12);
    EXPECT_EQ(hash(*rabbit), 13352864330171822347ull);
}

TEST(Medium, BuiltInFieldsStayAwayFromTheirFaces) {
    const auto cloud = makeCloudField(), wax = makeWaxField(), rabbit = makeWaxRabbit();
    for (const GreyVolume* field : {cloud.get(), wax.get(), rabbit.get()}) {
        const int last = field->frame.size.x - 1;
        for (int a = 0; a <= last; ++a)
            for (int b = 0; b <= last; ++b)
                for (const int face : {0, last}) {
                    ASSERT_EQ(field->at(face, a, b), 0);
                    ASSERT_EQ(field->at(a, face, b), 0);
                    ASSERT_EQ(field->at(a, b, face), 0);
                }
    }
    EXPECT_EQ(wax->at(30, 48, 48), 1000);  // wax
    EXPECT_EQ(wax->at(48, 48, 72), 0);     // the wick's hole
    EXPECT_EQ(rabbit->at(70, 68, 40), 1000);
    // The rabbit has two ears, each a few voxels thick.
    std::vector<int> runs;
    for (int j = 0, inside = 0; j < 128; ++j) {
        int most = 0;
        for (int i = 0; i < 128; ++i) most = std::max<int>(most, rabbit->at(i, j, 100));
        const bool now = most > 500;
        if (now && !inside) runs.push_back(0);
        if (now) ++runs.back();
        inside = now;
    }
    EXPECT_EQ(runs.size(), 2u);
}

TEST(MediumLook, NamesItsModels) {
    EXPECT_EQ(nameOf(MediumModel::Emission), "emission");
    EXPECT_EQ(nameOf(MediumModel::Indirect), "indirect");
}

}  // namespace
}  // namespace stereonav
