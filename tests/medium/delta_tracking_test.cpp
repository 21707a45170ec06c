// Single scattering, transmittance, emission and lamps by delta tracking against closed forms and against
// quadrature through the medium itself.
#include "engine/medium/paths/delta_tracking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/vector_relational.hpp>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/medium/paths/delta_tracking_flight.h"
#include "tests/medium/delta_tracking_scenes.h"

namespace stereonav {
namespace {

const glm::dvec3 kDownward{0, 0, -1};

TEST(DeltaTracking, TransmittanceOfHomogeneousSlabsIsExact) {
    for (const double depth : {1e-6, 0.01, 0.5, 2.0, 8.0, 50.0}) {
        const Medium slab = homogeneousSlab(depth / 3, 3, glm::vec3(0.0f));
        const Estimate seen = track(slab, litLook(kDownward), narrowView(kDownward), 4);
        // The float extinction of the table, and the margin of the bounds, 1e-5 of the depth.
        EXPECT_NEAR(seen.seen / std::exp(-depth), 1, 2e-5 * depth + 1e-6) << depth;
        EXPECT_EQ(seen.light, glm::dvec3(0.0)) << depth;
    }
}

TEST(DeltaTracking, TransmittanceOfALinearRampIsWithinItsNoise) {
    const Medium ramp = rampSlab(2, 1.5, glm::vec3(1.0f));
    MediumLook look = litLook(kDownward, MediumModel::Emission);
    // Emission of colour 1: every path that collides brings 1, so light is 1 - T with a binomial's variance.
    const Estimate seen = track(ramp, look, narrowView(kDownward), 2000);
    const double truth = std::exp(-2 * 1.5 / 2);
    const double n = 64 * 2000;
    EXPECT_NEAR(seen.error.x / std::sqrt(truth * (1 - truth) / n), 1, 0.02);
    EXPECT_LT(std::abs(seen.z(0, 1 - truth)), kStated_z);
    EXPECT_NEAR(seen.seen, truth, kStated_z * std::sqrt(truth * (1 - truth) / n));
}

// share of V5 and V6 without their code
double forwardShare(double x, double y) {
    return x / (x + y) * -std::expm1(-(x + y));
}
double backwardShare(double x, double y) {
    return std::abs(x - y) < 1e-12 ? x * std::exp(-x) : x * (std::exp(-y) - std::exp(-x)) / (x - y);
}

struct Angles {
    double eyeCosine, lightCosine;  // z of the ways: both down, or the light up
};

class SingleScattering : public testing::TestWithParam<Angles> {};

TEST_P(SingleScattering, OfAHomogeneousSlabIsTheClosedForm) {
    const auto [eye, light] = GetParam();
    const glm::vec3 color{1.0f, 0.5f, 0.125f};
    const glm::dvec3 way{std::sqrt(1 - eye * eye), 0, -eye};
    const glm::dvec3 lightWay{0, std::sqrt(1 - light * light), -light};
    for (const double depth : {0.01, 0.7, 4.0, 8.0, 30.0}) {
        if (light < 0 && depth > 8) continue;  // too rare to be seen by any path
        const Medium slab = homogeneousSlab(depth / 2, 2, color);
        MediumLook look = litLook(lightWay);
        look.light.radiance = {1, 2, 3};
        const Estimate seen = track(slab, look, narrowView(way), 1000);
        const double x = depth / eye, y = depth / std::abs(light);
        const double share = light > 0 ? forwardShare(x, y) : backwardShare(x, y);
        for (int c = 0; c < 3; ++c) {
            const double truth = color[c] * look.light.radiance[c] * share;
            // Beside the noise, what float properties and results allow.
            EXPECT_NEAR(seen.light[c], truth, kStated_z * seen.error[c] + 1e-5 * truth + 1e-12)
                << depth << " channel " << c;
            EXPECT_LT(seen.error[c], 0.05 * truth + 1e-6) << depth;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Ways, SingleScattering,
                         testing::Values(Angles{1, 1}, Angles{1, 0.5}, Angles{0.6, 0.9}, Angles{1, -1},
                                         Angles{0.5, -0.8}, Angles{0.8, 0.1}));

TEST(DeltaTracking, PhaseFunctionScalesSingleScattering) {
    const Medium slab = homogeneousSlab(1, 1, glm::vec3(1.0f));
    const glm::vec3 g{0.7f, 0.0f, -0.4f};
    for (const double cosine : {1.0, 0.3, -0.8}) {  // between the light's way and that back to the eye
        const glm::dvec3 lightWay{std::sqrt(1 - cosine * cosine), 0, cosine};
        MediumLook look = litLook(lightWay);
        look.phase = PhaseFunction::henyeyGreenstein(g);
        const Estimate seen = track(slab, look, narrowView(kDownward), 2000);
        const double y = 1 / std::abs(cosine);
        const double share = cosine < 0 ? forwardShare(1, y) : backwardShare(1, y);
        for (int c = 0; c < 3; ++c) {
            const double phase = (1 - g[c] * g[c]) / std::pow(1 + g[c] * g[c] - 2 * g[c] * cosine, 1.5);
            EXPECT_NEAR(seen.light[c], phase * share, kStated_z * seen.error[c] + 1e-3 * phase * share)
                << cosine << " channel " << c;
        }
    }
}

TEST(DeltaTracking, GlowAddsWhereItIsOpaque) {
    const glm::vec3 glow{1e-6f, 1, 1e6f};
    for (const double depth : {1e-3, 1.0, 40.0}) {
        const Medium slab = homogeneousSlab(depth, 1, glm::vec3(0.0f), glow);
        const Estimate seen = track(slab, litLook(kDownward), narrowView(kDownward), 4000);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen.light[c] / glow[c], -std::expm1(-depth),
                        kStated_z * seen.error[c] / glow[c] + 1e-5)
                << depth;
    }
}

// Eye and lamp at one place inside: R falls off, light and eye are weakened alike, nothing beyond the cone.
TEST(DeltaTracking, LampInsideLightsItsConeOnly) {
    const double extinction = 0.8, falloff = 2.5, length = 4;
    const Medium slab = homogeneousSlab(extinction, 10, glm::vec3(1.0f));
    MediumLook look;
    look.model = MediumModel::Direct;
    look.light.kind = MediumLight::Kind::Lamp;
    look.light.coneAngle = 1.0;
    look.light.falloff = falloff;
    look.light.position = {0, 0, -length};
    look.light.direction = kDownward;
    EyeView view = narrowView(kDownward, 1e-3, {0, 0, -length});
    const auto lit = [&](double s) {
        return extinction * std::exp(-2 * extinction * s) / (1 + s * s / (falloff * falloff));
    };
    double truth = 0;
    for (const Node& node : gaussNodes(60)) truth += 6 * node.weight * lit(6 * node.at);
    const Estimate seen = track(slab, look, view, 3000);
    EXPECT_NEAR(seen.light.x, truth, kStated_z * seen.error.x + 2e-3 * truth);
    look.light.direction = {0, 0.6, -0.8};  // 37 degrees off, the half cone is 29
    EXPECT_EQ(track(slab, look, view, 100).light.x, 0);
    look.light.direction = {0, 0, 1};
    look.light.atHead = true;  // shines along the view wherever it was put
    look.light.position = {1e6, 0, 0};
    EXPECT_NEAR(track(slab, look, view, 3000).light.x, truth, kStated_z * seen.error.x + 2e-3 * truth);
}

// A field without order, and what marching through Medium::at in small steps makes of it.
Medium randomMedium(const Perturbation& perturbation = {}) {
    VolumeFrame frame;
    frame.size = {7, 6, 9};
    frame.spacing = {0.3, 0.35, 0.25};
    frame.axes = {{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}};
    frame.origin = {0.5, -1.5, -2};
    auto field = std::make_shared<GreyVolume>(frame);
    std::uint32_t state = 7;
    for (std::size_t n = 0; n < frame.count(); ++n)
        field->values[n] = static_cast<std::int16_t>((state = state * 1664525u + 1013904223u) >> 22);
    const MediumTransfer transfer({{100, materialOf(0, {1, 1, 1})},
                                   {400, materialOf(0.5, {0.9f, 0.8f, 0.2f}, {0.1f, 0, 0})},
                                   {500, materialOf(3, {0.1f, 0.7f, 0.9f})},
                                   {900, materialOf(1, {0.5f, 0.5f, 1}, {0, 0, 0.3f})}},
                                  kReference, "random");
    return Medium(field, transfer, perturbation);
}

struct Marched {
    glm::dvec3 light{0.0};
    double depth = 0;
};
constexpr double kMarchStep = 0.015;

double marchedDepth(const Medium& medium, const glm::dvec3& from, const glm::dvec3& way, double time,
                    double length) {
    double depth = 0;
    for (double s = kMarchStep / 2; s < length; s += kMarchStep)
        depth += kMarchStep * medium.at(from + s * way, time).extinction;
    return depth;
}

Marched march(const Medium& medium, const MediumLook& look, const glm::dvec3& from, const glm::dvec3& way,
              double time, double length) {
    Marched sum;
    for (double s = kMarchStep / 2; s < length; s += kMarchStep) {
        const glm::dvec3 at = from + s * way;
        const OpticalProperties p = medium.at(at, time);
        if (p.extinction == 0) continue;
        const double direct = std::exp(-marchedDepth(medium, at, -look.light.direction, time, length));
        const double share = std::exp(-sum.depth) * -std::expm1(-kMarchStep * p.extinction);
        sum.light += share * (glm::dvec3(p.color * look.light.radiance) * direct + glm::dvec3(p.glow));
        sum.depth += kMarchStep * p.extinction;
    }
    return sum;
}

EyeView wideView() {
    EyeView view;
    view.forward = glm::normalize(glm::dvec3(-0.3, 0.4, -1));
    view.right = glm::normalize(glm::cross(view.forward, glm::dvec3(0, 1, 0)));
    view.up = glm::cross(view.right, view.forward);
    view.eye = glm::dvec3(0.2, 0.1, -1) - 3.5 * view.forward;
    view.head = view.eye;
    view.xMin = view.yMin = -0.35;
    view.xMax = view.yMax = 0.35;
    view.width = view.height = 6;
    return view;
}

void expectMarched(const Medium& medium, const EyeView& view, double time, double length) {
    MediumLook look = litLook({0.5, 0.2, -0.8});
    look.light.radiance = {1, 0.7f, 2};
    TrackingSetting setting;
    setting.samples = 600;
    setting.mostScatters = 1;
    const TrackedPicture seen = trackPicture(medium, look, view, setting, time);
    double squares = 0;
    int count = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 way = glm::normalize(view.rayDirection(x + 0.5, y + 0.5));
            const Marched truth = march(medium, look, view.eye, way, time, length);
            EXPECT_NEAR(seen.light.at(x, y).w, std::exp(-truth.depth), 0.1) << x << ' ' << y;
            for (int c = 0; c < 3 && truth.depth > 0; ++c) {
                const double deviation = std::sqrt(seen.variance.at(x, y)[c]) + 1e-9;
                const double z = (seen.light.at(x, y)[c] - truth.light[c]) / deviation;
                EXPECT_LT(std::abs(z), 4.5) << x << ' ' << y << " channel " << c;
                squares += z * z;
                ++count;
            }
        }
    // Chi-square by its normal approximation; channels of a pixel are correlated, so the bound is wide.
    ASSERT_GT(count, 20);
    EXPECT_LT((squares - count) / std::sqrt(6.0 * count), kStated_z);
}

TEST(DeltaTracking, AgreesWithMarchingThroughARandomField) {
    expectMarched(randomMedium(), wideView(), 0, 7);
}

Perturbation someNoise() {
    Perturbation noise;
    NoiseScale scale;
    scale.size = 2;
    scale.displacement = 0.2;
    scale.extinction = 0.6f;
    scale.velocity = {0.1, 0, 0.3};
    noise.scales = {scale};
    return noise;
}

TEST(DeltaTracking, AgreesWithMarchingThroughNoise) {
    expectMarched(randomMedium(someNoise()), wideView(), 12.5, 7);
}

// Extinction at random places against the bounds of their cells.
void expectWithinBounds(const Medium& medium, int least) {
    const double time = 345.6;
    const ExtinctionBounds bounds = makeExtinctionBounds(medium, time);
    PathRandom random(1, 2, 3);
    int inside = 0;
    for (int n = 0; n < 20000; ++n) {
        const glm::dvec3 u{random.uniform(), random.uniform(), random.uniform()};
        const glm::dvec3 place = glm::mix(medium.bounds().low, medium.bounds().high, u);
        const float extinction = medium.at(place, time).extinction;
        const glm::ivec3 cell(glm::floor(bounds.cellsFromWorld(place)));
        if (glm::any(glm::lessThan(cell, glm::ivec3(0))) ||
            glm::any(glm::greaterThanEqual(cell, bounds.size))) {
            ASSERT_EQ(extinction, 0) << n;
            continue;
        }
        ASSERT_GE(extinction, bounds.at(cell).least) << n;
        ASSERT_LE(extinction, bounds.at(cell).most) << n;
        inside += extinction > 0;
    }
    EXPECT_GT(inside, least);
}

Medium twoLayers(const Perturbation& perturbation = {}) {
    std::vector<HeightLayer> layers(2);
    for (int n = 0; n < 2; ++n) {
        HeightLayer& layer = layers[n];
        Plane<float> heights(40, 30);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x)
                heights.at(x, y) =
                    static_cast<float>(10 + 4 * n + 3 * std::sin(0.4 * x) * std::cos(0.3 * y + n));
        heights.at(7, 9) = std::numeric_limits<float>::quiet_NaN();
        layer.levels.push_back(std::move(heights));
        layer.below = 2;
        layer.above = 1;
        layer.taper = n;
        const MediumTransfer transfer({{5, materialOf(0.2, {0.9f, 0.9f, 0.5f})},
                                       {20, materialOf(1 + n, {0.3f, 0.9f, 0.9f}, {0, 0, 0.1f})}},
                                      kReference, "layer");
        layer.table = makeMediumTable(transfer, 0, 30);
        makeMipLevels(layer);
    }
    return Medium(std::move(layers), perturbation);
}

TEST(DeltaTracking, ExtinctionLiesWithinItsBounds) {
    for (const Perturbation& perturbation : {Perturbation{}, someNoise()}) {
        expectWithinBounds(randomMedium(perturbation), 5000);
        expectWithinBounds(twoLayers(perturbation), 3000);
    }
}

TEST(DeltaTracking, AgreesWithMarchingThroughLayers) {
    EyeView view = wideView();
    view.forward = glm::normalize(glm::dvec3(0.2, 0.3, -1));
    view.right = glm::normalize(glm::cross(view.forward, glm::dvec3(0, 1, 0)));
    view.up = glm::cross(view.right, view.forward);
    view.eye = glm::dvec3(20, 15, 12) - 8.0 * view.forward;
    view.width = view.height = 3;
    expectMarched(twoLayers(someNoise()), view, 3, 14);
}

TEST(DeltaTracking, BoundsFollowTheField) {
    VolumeFrame frame;
    frame.size = {2, 2, 101};
    auto field = std::make_shared<GreyVolume>(frame);
    for (std::size_t n = 0; n < frame.count(); ++n)
        field->values[n] = static_cast<std::int16_t>(10 * (n / 4));
    const MediumTransfer transfer({{0, materialOf(0, {1, 1, 1})}, {1000, materialOf(10, {1, 1, 1})}},
                                  kReference, "ramp");
    const ExtinctionBounds bounds = makeExtinctionBounds(Medium(field, transfer), 0);
    ASSERT_GT(bounds.size.z, 20);
    const double each = 100.0 / bounds.extent.z;  // extinction is z / 10
    for (int k = 0; k < bounds.size.z; ++k) {
        EXPECT_NEAR(bounds.at({0, 0, k}).least, 0.1 * each * k, 0.02) << k;
        EXPECT_NEAR(bounds.at({0, 0, k}).most, std::min(10.0, 0.1 * each * (k + 1)), 0.02) << k;
    }
}

// One bound for the whole medium: the greatest, times `factor`.
ExtinctionBounds coarseBounds(const ExtinctionBounds& bounds, float factor) {
    ExtinctionBounds coarse = bounds;
    float most = 0;
    for (const ExtinctionRange& cell : bounds.cells) most = std::max(most, cell.most);
    std::fill(coarse.cells.begin(), coarse.cells.end(), ExtinctionRange{0, most * factor});
    return coarse;
}

TEST(DeltaTracking, DoesNotDependOnTheMajorant) {
    const Medium medium = randomMedium(someNoise());
    const MediumLook look = litLook({0.5, 0.2, -0.8}, MediumModel::Indirect);
    TrackingSetting setting;
    setting.samples = 600;
    std::vector<Estimate> means;
    const EyeView view = wideView();
    const ExtinctionBounds fine = makeExtinctionBounds(medium, 0);
    for (const ExtinctionBounds& bounds : {fine, coarseBounds(fine, 1), coarseBounds(fine, 2)}) {
        means.push_back(meanOf(trackRows(medium, bounds, look, view, setting, 0, {0, view.height})));
        ++setting.seed;
    }
    for (std::size_t n = 1; n < means.size(); ++n)
        for (int c = 0; c < 3; ++c) {
            const double error = std::hypot(means[0].error[c], means[n].error[c]);
            EXPECT_LT(std::abs(means[n].light[c] - means[0].light[c]), kStated_z * error) << n << ' ' << c;
            EXPECT_LT(error, 0.02 * means[0].light[c]) << n << ' ' << c;
            EXPECT_NEAR(means[n].seen, means[0].seen, 0.01) << n;
        }
}

TEST(DeltaTracking, DoesNotDependOnTheThreadCount) {
    const Medium medium = randomMedium(someNoise());
    const MediumLook look = litLook({0.5, 0.2, -0.8}, MediumModel::Indirect);
    TrackingSetting setting;
    setting.samples = 4;
    const int before = threadCount();
    setThreadCount(1);
    const TrackedPicture one = trackPicture(medium, look, wideView(), setting);
    setThreadCount(3);
    const TrackedPicture three = trackPicture(medium, look, wideView(), setting);
    setThreadCount(before);
    int lit = 0;
    for (int y = 0; y < one.light.height(); ++y)
        for (int x = 0; x < one.light.width(); ++x) {
            ASSERT_EQ(one.light.at(x, y), three.light.at(x, y)) << x << ' ' << y;
            ASSERT_EQ(one.variance.at(x, y), three.variance.at(x, y)) << x << ' ' << y;
            lit += one.light.at(x, y).x > 0;
        }
    EXPECT_GT(lit, 10);
}

TEST(DeltaTracking, RowsAreThoseOfTheWholePicture) {
    const Medium medium = randomMedium(someNoise());
    const MediumLook look = litLook({0.5, 0.2, -0.8}, MediumModel::Indirect);
    const EyeView view = wideView();
    TrackingSetting setting;
    setting.samples = 2;
    const ExtinctionBounds bounds = makeExtinctionBounds(medium, 0);
    const TrackedPicture whole = trackPicture(medium, look, view, setting);
    const int middle = view.height / 2 - 1;
    int lit = 0;
    for (const PictureRows& rows : {PictureRows{0, middle}, PictureRows{middle, view.height + 3}}) {
        const TrackedPicture part = trackRows(medium, bounds, look, view, setting, 0, rows);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const bool in = y >= rows.first && y < rows.end;
                ASSERT_EQ(part.light.at(x, y), in ? whole.light.at(x, y) : glm::vec4(0)) << x << ' ' << y;
                ASSERT_EQ(part.variance.at(x, y), in ? whole.variance.at(x, y) : glm::vec3(0));
                lit += in && whole.light.at(x, y).x > 0;
            }
    }
    EXPECT_GT(lit, 10);
}

TEST(DeltaTracking, EmptyMediumShowsTheBackground) {
    const Estimate seen = track(Medium(), litLook(kDownward), narrowView(kDownward), 2, 8);
    EXPECT_EQ(seen.light, glm::dvec3(0.0));
    EXPECT_EQ(seen.seen, 1);
}

TEST(DeltaTracking, ViewsFromNowhereSeeNothing) {
    EyeView view = narrowView(kDownward);
    view.eye.y = std::numeric_limits<double>::quiet_NaN();
    const Estimate seen = track(homogeneousSlab(1, 1, glm::vec3(1.0f)), litLook(kDownward), view, 2);
    EXPECT_EQ(seen.light, glm::dvec3(0.0));
    EXPECT_EQ(seen.seen, 1);
}

TEST(DeltaTracking, OneSampleHasNoKnownVariance) {
    EXPECT_TRUE(std::isinf(track(Medium(), litLook(kDownward), narrowView(kDownward), 1).error.x));
}

TEST(DeltaTracking, RefusesWhatHasNoPaths) {
    const Medium slab = homogeneousSlab(1, 1, glm::vec3(1.0f));
    const auto message = [&](const Medium& medium, const MediumLook& look, int samples, int scatters) {
        try {
            track(medium, look, narrowView(kDownward), samples, scatters);
        } catch (const Error& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    const MediumLook look = litLook(kDownward);
    EXPECT_THAT(message(slab, litLook(kDownward, MediumModel::Surface), 1, 1),
                testing::HasSubstr("surface model"));
    EXPECT_THAT(message(slab, look, 0, 1), testing::HasSubstr("at least 1 sample, got 0"));
    EXPECT_THAT(message(slab, look, 1, 0), testing::HasSubstr("at least 1 scatter, got 0"));
    MediumMaterial shiny = materialOf(1, glm::vec3(1.0f));
    shiny.surface = 0.5;
    const Medium hard(slabField(1, 500, 500),
                      MediumTransfer({{0, shiny}, {1000, shiny}}, kReference, "hard"));
    EXPECT_THAT(message(hard, look, 1, 1), testing::HasSubstr("surface weight 0.5"));
}

}  // namespace
}  // namespace stereonav
