// Detail below the sample spacing: kernels against the plain statement, and what it must not change.
#include "terrain/cast/ground_detail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/render/eye_renderer.h"
#include "engine/simd/simd_target.h"
#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/light/sky_source.h"
#include "tests/oracle/plain_detail.h"

namespace stereonav {
namespace {

// Hills of one grey, 30 m by 24 m a sample; level in the west, as a lake.
TerrainScene greyHills(bool detail, double sunElevation = 0.6, bool weathered = false) {
    constexpr int kSide = 48;
    std::vector<float> heights;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i)
            heights.push_back(
                i < 20 ? 0.0f
                       : static_cast<float>(9 * (i - 19) + 25 * std::sin(0.4 * i) * std::cos(0.3 * j)));
    TerrainScene terrain;
    terrain.ground = Heightfield(kSide, kSide, glm::dvec2(30, 24), std::move(heights), "hills");
    Plane<PackedColor> grey(2, 2);
    for (int k = 0; k < 4; ++k) grey.at(k % 2, k / 2) = packColor(glm::vec3(0.25f, 0.2f, 0.1f));
    terrain.color = ColorTexture(grey, glm::dvec2(-0.5), glm::dvec2(kSide / 2.0));
    terrain.sky = readSky({}).map;
    terrain.look.sunElevation = sunElevation;
    terrain.detail = detail;
    terrain.weathered = weathered;
    return terrain;
}

EyeView viewOf(const glm::dvec3& eye, double heading, double pitch, double roll = 0, int width = 96) {
    return makeEyeView(poseFromAngles(eye, heading, pitch, roll), Lens{width, width * 3 / 4, 0.8, 1.0, 0.5});
}

EyeImage cast(const TerrainScene& scene, const EyeView& view, SimdTarget target = SimdTarget::Auto) {
    EyeImage image;
    image.resize(view.width, view.height);
    renderEye(TerrainRenderer(scene, target), view, image);
    return image;
}

const EyeView kViews[] = {viewOf({250, 0, 160}, 1.2, -0.3), viewOf({400, 100, 350}, 4.0, -1.1),
                          viewOf({200, -200, 140}, 0.2, -0.5, 0.7), viewOf({500, 0, 9000}, 0, -1.4)};

glm::vec3 rootsOf(PackedColor c) {
    return {c & 1023, c >> 10 & 1023, c >> 20 & 1023};
}

// By hits of the plain cell walk, in double precision.
void expectAsThePlainStatementSays(GroundDetail::Kind kind) {
    const bool weathered = kind == GroundDetail::Kind::Weathered;
    const TerrainScene plain = greyHills(false), detailed = greyHills(true, 0.6, weathered);
    const Heightfield& ground = plain.ground;
    const GroundDetail detail(ground, kind);
    const DetailData data = detail.forKernels(plain.look);
    for (const SimdTarget target : simdTargets())
        for (int k = 0; k < 3; ++k) {
            const EyeView& view = kViews[k];
            const EyeImage before = cast(plain, view, target), after = cast(detailed, view, target);
            const double pixel = glm::length(view.rayDirection(10.5, 8.5) - view.rayDirection(9.5, 8.5));
            double squares = 0, changed = 0, count = 0;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    ASSERT_EQ(before.viewDepth.at(x, y), after.viewDepth.at(x, y)) << "depth is no shading";
                    if (!std::isfinite(before.viewDepth.at(x, y))) {
                        ASSERT_EQ(before.color.at(x, y), after.color.at(x, y));
                        continue;
                    }
                    const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
                    const GroundHit hit = castPlain(ground, view.eye, ray, 0);
                    ASSERT_TRUE(std::isfinite(hit.t));
                    const double h00 = ground.sample(hit.i, hit.j), h10 = ground.sample(hit.i + 1, hit.j),
                                 h01 = ground.sample(hit.i, hit.j + 1),
                                 h11 = ground.sample(hit.i + 1, hit.j + 1);
                    const double east = (h10 - h00 + hit.v * (h11 - h01 - h10 + h00)) / ground.spacing().x;
                    const double north = (h01 - h00 + hit.u * (h11 - h01 - h10 + h00)) / ground.spacing().y;
                    const double approach = std::abs(ray.z - ray.x * east - ray.y * north);
                    const double footprint = hit.t * pixel * std::max(1.0, glm::length(ray) / approach);
                    const double light = detailAt(data, hit.i, hit.j, hit.u, hit.v, footprint);
                    const glm::vec3 is = rootsOf(after.color.at(x, y));
                    const glm::vec3 expected =
                        rootsOf(before.color.at(x, y)) * static_cast<float>(std::sqrt(1 + light));
                    const double apart = glm::length(is - glm::min(expected, glm::vec3(1023)));
                    squares += apart * apart;
                    changed += std::abs(light) > 0.02;
                    ++count;
                }
            ASSERT_GT(count, 1000);
            EXPECT_GT(changed, 0.3 * count) << k;
            // In steps of 1/1023 of roots, three channels: places that float has are off by some 1e-5 of a
            // cell, and reciprocals by 1e-3 in the fade.
            EXPECT_LT(std::sqrt(squares / count), 1.6) << nameOf(target) << " " << k;
        }
}

TEST(GroundDetail, EachSetShadesAsThePlainStatementSays) {
    expectAsThePlainStatementSays(GroundDetail::Kind::Rough);
}
TEST(GroundDetail, EachSetShadesWeatheredReliefAsThePlainStatementSays) {
    expectAsThePlainStatementSays(GroundDetail::Kind::Weathered);
}

TEST(GroundDetail, SetsAgree) {
    const TerrainScene scene = greyHills(true);
    const std::vector<SimdTarget> targets = simdTargets();
    const EyeImage first = cast(scene, kViews[0], targets.front());
    for (const SimdTarget target : targets) {
        const EyeImage image = cast(scene, kViews[0], target);
        int far = 0;
        for (int y = 0; y < image.color.height(); ++y)
            for (int x = 0; x < image.color.width(); ++x)
                far += glm::length(rootsOf(image.color.at(x, y)) - rootsOf(first.color.at(x, y))) > 6;
        EXPECT_LT(far, 0.003 * image.color.width() * image.color.height());
    }
}

TEST(GroundDetail, NothingWhereNoPixelIsFinerThanTheSamplesAndOnLevelGround) {
    const TerrainScene plain = greyHills(false);
    const EyeView lake = viewOf({-500, 0, 12}, 4.7, -0.4);
    for (const bool weathered : {false, true})
        for (const EyeView& view : {kViews[3], lake}) {
            const EyeImage before = cast(plain, view), after = cast(greyHills(true, 0.6, weathered), view);
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) ASSERT_EQ(before.color.at(x, y), after.color.at(x, y));
        }
    const TerrainScene night = greyHills(true, -0.5), plainNight = greyHills(false, -0.5);
    const EyeImage dark = cast(night, kViews[0]), before = cast(plainNight, kViews[0]);
    for (int y = 0; y < dark.color.height(); ++y)
        for (int x = 0; x < dark.color.width(); ++x) ASSERT_EQ(dark.color.at(x, y), before.color.at(x, y));
}

// Returns mean and rms of the light that is added on hills, at all octaves.
std::pair<double, double> addedLight(GroundDetail::Kind kind) {
    const Heightfield ground = greyHills(false).ground;
    const GroundDetail detail(ground, kind);
    const DetailData data = detail.forKernels(TerrainLook());
    double sum = 0, squares = 0;
    int count = 0;
    for (int k = 0; k < 20000; ++k) {
        const double u = std::fmod(k * 0.7548776662, 1.0), v = std::fmod(k * 0.5698402910, 1.0);
        const double light = detailAt(data, 21 + k % 25, k / 25 % 46, u, v, 1e-3);
        sum += light;
        squares += light * light;
        ++count;
    }
    return {sum / count, std::sqrt(squares / count)};
}

// Light is moved about, not added.
TEST(GroundDetail, TheMeanStays) {
    const auto [mean, rms] = addedLight(GroundDetail::Kind::Rough);
    EXPECT_NEAR(mean, 0, 0.01);
    EXPECT_GT(rms, 0.05);
    EXPECT_LT(rms, 0.35);
    const auto [weatheredMean, weatheredRms] = addedLight(GroundDetail::Kind::Weathered);
    EXPECT_NEAR(weatheredMean, 0, 0.015);
    EXPECT_GT(weatheredRms, 0.05);
    EXPECT_LT(weatheredRms, 0.85 * rms);
}

// The slopes that are added: measured in the map, and as the class tells them. Finer octaves are flatter.
TEST(GroundDetail, WeatheredReliefIsModeratelySteep) {
    const Heightfield ground = greyHills(false).ground;
    const GroundDetail rough(ground), weathered(ground, GroundDetail::Kind::Weathered);
    EXPECT_NEAR(rough.rmsSlope(), 0.46, 0.02);
    EXPECT_LT(weathered.rmsSlope(), 0.5 * rough.rmsSlope());
    const auto slopesOf = [](const GroundDetail& detail) {
        // A sun at the horizon in the east, then in the north: the light is the slope along that direction.
        std::vector<double> rms(kDetailOctaves);
        for (const double azimuth : {0.5 * M_PI, 0.0}) {
            TerrainLook look;
            look.ambient = 0;
            look.sunAzimuth = azimuth;
            look.sunElevation = 0.25 * M_PI;  // level ground gets as much light as walls
            const DetailData data = detail.forKernels(look);
            for (int k = 0; k < kDetailOctaves; ++k) {
                double square = 0;
                for (int n = 0; n < kReliefSide * kReliefSide; ++n) {
                    const std::uint32_t word = data.relief[n / kReliefSide * kReliefPitch + n % kReliefSide];
                    const double light = data.octave[k].lightX * (double(word & 0x7FF) - 1024) +
                                         data.octave[k].lightY * (double(word >> 11 & 0x7FF) - 1024);
                    square += light * light / (kReliefSide * kReliefSide);
                }
                rms[k] += square;
            }
        }
        for (double& r : rms) r = std::sqrt(r);
        return rms;
    };
    const std::vector<double> slopes = slopesOf(weathered);
    double all = 0;
    for (int k = 0; k < kDetailOctaves; ++k) {
        if (k > 0) {
            EXPECT_LT(slopes[k], 0.9 * slopes[k - 1]);
        }
        all += slopes[k] * slopes[k];
    }
    EXPECT_NEAR(std::sqrt(all), weathered.rmsSlope(), 0.05 * weathered.rmsSlope());
}

// Continuous over the borders of cells, and fades without a step.
void expectNoSeams(GroundDetail::Kind kind) {
    const Heightfield ground = greyHills(false).ground;
    const GroundDetail detail(ground, kind);
    const DetailData data = detail.forKernels(TerrainLook());
    for (int k = 0; k < 200; ++k) {
        const double v = k / 200.0;
        EXPECT_NEAR(detailAt(data, 30, 20, 1 - 1e-9, v, 0.01), detailAt(data, 31, 20, 0, v, 0.01), 1e-5);
        EXPECT_NEAR(detailAt(data, 30, 20, v, 1 - 1e-9, 0.01), detailAt(data, 30, 21, v, 0, 0.01), 1e-5);
        const double footprint = 0.02 * std::pow(1.05, k);
        EXPECT_NEAR(detailAt(data, 30, 20, 0.3, 0.6, footprint),
                    detailAt(data, 30, 20, 0.3, 0.6, footprint * 1.0001), 1e-3);
    }
    EXPECT_EQ(detailAt(data, 30, 20, 0.3, 0.6, 30), 0);
}

TEST(GroundDetail, HasNoSeams) {
    expectNoSeams(GroundDetail::Kind::Rough);
    expectNoSeams(GroundDetail::Kind::Weathered);
}

}  // namespace
}  // namespace stereonav
