// The fast sweep against the plain one: every model, both directions, lights of both kinds, noise, layers,
// gradients, on every instruction set. And what both must not depend on.
#include "engine/medium/sweep/medium_sweep.h"

#include <random>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/simd/simd_target.h"
#include "sweep_scenes.h"

namespace stereonav {
namespace {

using test::makeField;
using test::sun;
using test::viewFrom;

// Light that eyes read is kept in 15 bits, weights between voxels in 14; the rest is float. Of light up to 1.
constexpr double kTolerance = 5e-4;

struct Scene {
    Medium medium;
    MediumLook look;
    SweepSetting setting;
    std::vector<EyeView> eyes;
    double time = 0;
};

MediumMaterial randomMaterial(std::mt19937& random, double surface) {
    std::uniform_real_distribution<float> u(0, 1);
    MediumMaterial m;
    m.color = {u(random), u(random), u(random)};
    m.opacity = 0.7 * u(random);
    m.transport = {0.3f + 0.7f * u(random), 0.3f + 0.7f * u(random), 0.3f + 0.7f * u(random)};
    m.surface = surface * u(random);
    return m;
}

// Smooth humps with empty space between them. Where places are displaced all fades out before the faces,
// since which side of a face a place is on is up to a rounding.
std::shared_ptr<GreyVolume> humps(const glm::ivec3& size, bool fades) {
    auto field = makeField(size, 2.0, {0.3, -0.2, 0.1}, [&](const glm::ivec3& v) {
        const double hump = std::sin(0.7 * v.x) * std::sin(0.5 * v.y + 1) * std::sin(0.6 * v.z + 2);
        const glm::ivec3 edge = glm::min(v, size - 1 - v);
        const double within = fades ? std::min({edge.x, edge.y, edge.z, 2}) / 2.0 : 1.0;
        return 420 + within * (80 + 480 * hump);
    });
    field->scale = 0.5;
    field->offset = -20;
    return field;
}

Perturbation noisy() {
    Perturbation p;
    NoiseScale coarse, fine;
    coarse.size = 1.7;
    coarse.displacement = 0.1;
    coarse.velocity = {0.3, 0, -0.2};
    fine.size = 0.6;
    fine.extinction = 0.5f;
    fine.color = {0.3f, 0.0f, -0.2f};
    fine.indirect = {0.2f, 0.4f, 0.0f};
    p.scales = {coarse, fine};
    return p;
}

enum class Kind { Grid, Surface, Ramp, Noise, Regions, Layers };

Medium mediumOf(Kind kind, std::mt19937& random) {
    if (kind == Kind::Regions) {
        std::vector<MediumRegion> regions(2);
        for (int n = 0; n < 2; ++n) {
            const double v = 100 + 150 * n, g = 200 * n;
            regions[n] = {
                {v, v + 50, v + 100, v + 200}, {g, g + 50, g + 1e4, g + 2e4}, randomMaterial(random, 1)};
        }
        return Medium(humps({19, 17, 15}, false), MediumTransfer(regions, 0.3, "test"));
    }
    if (kind == Kind::Layers) {
        std::vector<HeightLayer> layers(2);
        for (int n = 0; n < 2; ++n) {
            HeightLayer& layer = layers[n];
            layer.levels.emplace_back(21, 17);
            for (int y = 0; y < 17; ++y)
                for (int x = 0; x < 21; ++x)
                    layer.levels[0].at(x, y) =
                        static_cast<float>(0.2 * std::sin(0.5 * x + n) * std::cos(0.4 * y) + 0.5 * n - 0.2);
            layer.levels[0].at(3, 4) = std::numeric_limits<float>::quiet_NaN();
            layer.originX = layer.originY = -1;
            layer.spacing = 0.1;
            layer.below = 0.3;
            layer.above = 0.1 * n;
            layer.taper = 0.05;
            makeMipLevels(layer);
            std::vector<MediumPoint> points{{-1, randomMaterial(random, 0.5)},
                                            {1, randomMaterial(random, 0.5)}};
            layer.table = makeMediumTable(MediumTransfer(points, 0.3, "test"), layer.lowest, layer.highest);
        }
        return Medium(std::move(layers), noisy());
    }
    const double surface = kind == Kind::Surface || kind == Kind::Ramp ? 1 : 0;
    std::vector<MediumPoint> points(3);
    for (int n = 0; n < 3; ++n) points[n] = {200.0 + 90 * n, randomMaterial(random, surface)};
    points[0].material.opacity = 0;
    points[1].material.glow = {0.2f, 0.0f, 0.1f};
    std::vector<MediumPoint> all{{-100, points[0].material}};
    all.insert(all.end(), points.begin(), points.end());
    MediumTransfer transfer(all, 0.3, "test");
    if (kind == Kind::Ramp) transfer.setSurfaceRamp(200, 1500, "test");
    return Medium(humps({19, 17, 15}, kind == Kind::Noise), transfer,
                  kind == Kind::Noise ? noisy() : Perturbation{});
}

Scene sceneOf(Kind kind, MediumModel model, bool lamp, bool forward, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> n;
    Scene s{mediumOf(kind, random), {}, {}, {}, 1.5};
    s.look.model = model;
    glm::dvec3 view = glm::normalize(glm::dvec3(n(random), n(random), n(random)));
    glm::dvec3 way = glm::normalize(glm::dvec3(n(random), n(random), n(random)));
    if ((glm::dot(view, way) > 0) != forward) way = -way;
    s.look.light = sun(way);
    if (lamp) {
        s.look.light.kind = MediumLight::Kind::Lamp;
        s.look.light.position = glm::dvec3(0.1, 0, 0) - (seed % 2 ? 0.3 : 3.0) * way;
        s.look.light.coneAngle = seed % 2 ? 1.5 : 0.8;
        s.look.light.falloff = 2;
    }
    s.look.phase = PhaseFunction::henyeyGreenstein({0.3f, 0.0f, -0.4f});
    s.look.indirectShare = 0.7f;
    s.setting.slices = 27;
    s.setting.lightSize = 24;
    s.setting.sharedWidth = 0;  // the plain sweep shares nothing; see sweep_sharing_test.cpp
    s.eyes = {viewFrom(-4.0 * view, {0, 0, 0}, 0.35, 27, 21), viewFrom(-4.0 * view, {0, 0, 0}, 0.35, 27, 21)};
    s.eyes[1].eye += 0.1 * s.eyes[1].right;
    return s;
}

std::vector<MediumPicture> fast(const Scene& s, SimdTarget target) {
    MediumSweep sweep(s.medium, target);
    std::vector<MediumPicture> pictures(s.eyes.size());
    sweep.render(s.look, s.setting, s.eyes, s.eyes[0].head, s.time, pictures);
    return pictures;
}

std::vector<MediumPicture> plain(const Scene& s) {
    return plainSweep(s.medium, s.look, s.setting,
                      makeSweepGeometry(s.medium, s.look, s.setting, s.eyes, s.eyes[0].head), s.time);
}

// Worst difference of light, pixels in which it is beyond the tolerance, and pixels whose depth differs by
// more than rounding.
struct Difference {
    double light = 0, brightest = 0;
    int beyond = 0, depths = 0, pixels = 0;
};
Difference differenceOf(const std::vector<MediumPicture>& a, const std::vector<MediumPicture>& b) {
    Difference d;
    for (std::size_t n = 0; n < a.size(); ++n)
        for (int y = 0; y < a[n].light.height(); ++y)
            for (int x = 0; x < a[n].light.width(); ++x) {
                const glm::vec4 p = a[n].light.at(x, y), q = b[n].light.at(x, y);
                double worst = 0;
                for (int k = 0; k < 4; ++k) {
                    const double away = std::abs(p[k] - q[k]);
                    worst = away <= worst ? worst : away;  // NaN is kept
                }
                d.light = worst <= d.light ? d.light : worst;
                d.beyond += !(worst <= kTolerance);
                d.brightest = std::max<double>(d.brightest, p.x);
                const float s = a[n].viewDepth.at(x, y), t = b[n].viewDepth.at(x, y);
                d.depths += !(s == t || std::abs(s - t) < 1e-4f);
                ++d.pixels;
            }
    return d;
}

struct Case {
    Kind kind;
    MediumModel model;
    bool lamp, forward;
};
std::string nameOfCase(const testing::TestParamInfo<Case>& info) {
    const Case& c = info.param;
    const char* kinds[] = {"Grid", "Surface", "Ramp", "Noise", "Regions", "Layers"};
    const char* models[] = {"Emission", "Surface", "Direct", "Indirect"};
    return std::string(kinds[static_cast<int>(c.kind)]) + models[static_cast<int>(c.model)] +
           (c.lamp ? "Lamp" : "Sun") + (c.forward ? "Forward" : "Backward");
}
std::vector<Case> cases() {
    std::vector<Case> all;
    for (const Kind kind : {Kind::Grid, Kind::Surface, Kind::Ramp, Kind::Noise, Kind::Regions, Kind::Layers})
        for (const MediumModel model :
             {MediumModel::Emission, MediumModel::Surface, MediumModel::Direct, MediumModel::Indirect})
            for (const bool lamp : {false, true})
                for (const bool forward : {false, true}) all.push_back({kind, model, lamp, forward});
    return all;
}

class MediumSweepAgrees : public testing::TestWithParam<Case> {};

TEST_P(MediumSweepAgrees, withThePlainSweep) {
    const Case& c = GetParam();
    const unsigned seed = 7 * static_cast<unsigned>(c.kind) + c.lamp;
    const Scene scene = sceneOf(c.kind, c.model, c.lamp, c.forward, seed);
    const std::vector<MediumPicture> truth = plain(scene);
    for (const SimdTarget target : simdTargets()) {
        const Difference d = differenceOf(truth, fast(scene, target));
        EXPECT_GT(d.brightest, 1e-3);
        // Layers have hard edges where heights are unknown, and the nearest one gives the normal: a sample
        // there is on one side or the other by a rounding.
        if (c.kind == Kind::Layers) {
            EXPECT_LE(d.beyond, d.pixels / 100) << static_cast<int>(target);
            EXPECT_LE(d.light, 0.1) << static_cast<int>(target);
        } else {
            EXPECT_LE(d.light, kTolerance) << static_cast<int>(target);
        }
        // Where extinction fades out evenly, a rounding decides which sample is the first.
        EXPECT_LE(d.depths, d.pixels / 50) << static_cast<int>(target);
    }
}
INSTANTIATE_TEST_SUITE_P(All, MediumSweepAgrees, testing::ValuesIn(cases()), nameOfCase);

// Baked light on a grid that lies askew, a part of its texels unknown where `holes`, the others of this
// weight.
std::shared_ptr<IlluminationVolume> bakedTexels(std::mt19937& random, bool holes = true, float weight = 1,
                                                float brightest = 1) {
    VolumeFrame frame;
    frame.size = {6, 7, 5};
    frame.spacing = {0.4, 0.35, 0.45};
    frame.origin = {-0.9, -1.2, -0.8};
    const double c = std::cos(0.3), s = std::sin(0.3);
    frame.axes = glm::dmat3({c, s, 0}, {-s, c, 0}, {0, 0, 1});
    auto light = std::make_shared<IlluminationVolume>(frame);
    std::uniform_real_distribution<float> u(0, 1);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                light->texels[light->layout.index(i, j, k)] = packTexel(
                    brightest * glm::vec3(u(random), u(random), u(random)), holes && i == 1 ? 0.0f : weight);
    return light;
}

TEST(MediumSweep, agreesOnBakedLight) {
    for (const Kind kind : {Kind::Surface, Kind::Ramp, Kind::Noise, Kind::Layers})
        for (const auto& [use, beyond] :
             {std::pair{BakedLook::Use::Irradiance, false}, std::pair{BakedLook::Use::Openness, false},
              std::pair{BakedLook::Use::Irradiance, true}}) {
            std::mt19937 random(11);
            Scene scene = sceneOf(kind, MediumModel::Indirect, false, true, 9);
            if (kind == Kind::Noise) {
                MediumTransfer shiny({{-100, randomMaterial(random, 1)}, {400, randomMaterial(random, 1)}},
                                     0.3, "test");
                scene.medium = Medium(humps({19, 17, 15}, true), shiny, noisy());
            }
            const std::vector<MediumPicture> lamp = plain(scene);
            scene.look.baked.light = bakedTexels(random);
            if (beyond) scene.look.baked.beyond = bakedTexels(random, false);
            scene.look.baked.use = use;
            scene.look.baked.exposure = 0.8f;
            scene.look.baked.lampShare = 0.3f;
            const std::vector<MediumPicture> truth = plain(scene);
            EXPECT_GT(differenceOf(lamp, truth).light, (beyond ? 10 : 20) * kTolerance)
                << static_cast<int>(kind);
            for (const SimdTarget target : simdTargets()) {
                const Difference d = differenceOf(truth, fast(scene, target));
                // Layers: as above.
                EXPECT_LE(d.beyond, kind == Kind::Layers ? d.pixels / 100 : 0)
                    << static_cast<int>(kind) << ' ' << static_cast<int>(target);
                EXPECT_LE(d.light, kind == Kind::Layers ? 0.1 : kTolerance)
                    << static_cast<int>(kind) << ' ' << static_cast<int>(target);
            }
        }
}

// Weights of nearly nothing, dim light under a high exposure, light beyond half floats: all finite, and as
// the plain sweep has it.
TEST(MediumSweep, agreesOnBakedLightAtTheEndsOfItsNumbers) {
    const struct {
        float weight, brightest, exposure;
        double most;  // largest error of the light, which may be far above 1
    } cases[] = {{1.0f / 1024, 0x1p-18f, 0x1p18f, kTolerance},
                 {1, 0x1p-20f, 0x1p19f, 2 * kTolerance},
                 {1, 1e30f, 1e-6f, kTolerance},
                 {1, 1e30f, 1e6f, 1e8},
                 {1, 1, std::numeric_limits<float>::quiet_NaN(), kTolerance},
                 {1, 1, std::numeric_limits<float>::infinity(), 1e16}};
    for (const auto& c : cases) {
        std::mt19937 random(13);
        Scene scene = sceneOf(Kind::Surface, MediumModel::Indirect, false, true, 9);
        scene.look.baked.light = bakedTexels(random, true, c.weight, c.brightest);
        scene.look.baked.exposure = c.exposure;
        scene.look.baked.beyond = bakedTexels(random, false, 1, c.brightest);
        const std::vector<MediumPicture> truth = plain(scene);
        for (const SimdTarget target : simdTargets()) {
            const Difference d = differenceOf(truth, fast(scene, target));
            EXPECT_TRUE(std::isfinite(d.brightest)) << c.exposure;
            EXPECT_LE(d.light, c.most) << c.exposure << ' ' << static_cast<int>(target);
        }
    }
}

// A narrow spot: scattered light gets beside the cone, direct light does not; the fast sweep agrees there
// too, and a parallel light afterwards finds the buffer as it was.
TEST(MediumSweep, scatteredLightLeavesALampsCone) {
    for (const bool forward : {true, false}) {
        Scene s = sceneOf(Kind::Grid, MediumModel::Indirect, true, forward, 12);
        s.look.light.coneAngle = 0.12;
        s.look.light.radiance = glm::vec3(8);  // the medium is thin
        s.setting.lightSize = 32;
        s.setting.coneAngle = 1.2;
        s.setting.blurLength = 0.2;
        const std::vector<MediumPicture> truth = plain(s);
        Scene direct = s;
        direct.look.model = MediumModel::Direct;
        const std::vector<MediumPicture> straight = plain(direct);
        int beside = 0;
        for (int y = 0; y < 21; ++y)
            for (int x = 0; x < 27; ++x) {
                // Green: the medium's own glow has none.
                beside += straight[0].light.at(x, y).y < 1e-6f && truth[0].light.at(x, y).y > 4 * kTolerance;
            }
        EXPECT_GT(beside, 10) << forward;
        for (const SimdTarget target : simdTargets()) {
            MediumSweep sweep(s.medium, target);
            std::vector<MediumPicture> spot(2), after(2);
            sweep.render(s.look, s.setting, s.eyes, s.eyes[0].head, s.time, spot);
            EXPECT_LE(differenceOf(truth, spot).light, kTolerance) << static_cast<int>(target) << forward;
            Scene sunny = s;
            sunny.look.light.kind = MediumLight::Kind::Parallel;
            sweep.render(sunny.look, s.setting, s.eyes, s.eyes[0].head, s.time, after);
            EXPECT_EQ(differenceOf(fast(sunny, target), after).light, 0);
        }
    }
}

// Light across the view, where slabs lean most (V11): taps near and far, before and behind the right angle.
TEST(MediumSweep, agreesWhereSlabsLean) {
    for (const Kind kind : {Kind::Grid, Kind::Noise})
        for (const bool lamp : {false, true})
            for (const double degrees : {80.0, 100.0}) {
                Scene s = sceneOf(kind, MediumModel::Indirect, lamp, true, 14);
                const double angle = degrees * std::acos(-1.0) / 180;
                const glm::dvec3 way =
                    glm::normalize(std::cos(angle) * s.eyes[0].forward +
                                   std::sin(angle) * (0.8 * s.eyes[0].right - 0.6 * s.eyes[0].up));
                s.look.light.direction = way;
                s.look.light.position = -3.0 * way;
                s.setting.coneAngle = degrees < 90 ? 0.4 : 1.4;  // taps nearer and farther than a texel
                s.setting.blurLength = 1;
                s.look.indirectShare = 1;
                s.look.light.falloff = 0;
                const std::vector<MediumPicture> truth = plain(s);
                SweepGeometry upright =
                    makeSweepGeometry(s.medium, s.look, s.setting, s.eyes, s.eyes[0].head);
                EXPECT_GT(upright.leaning, 0.3);
                upright.leaning = 0;
                EXPECT_GT(differenceOf(truth, plainSweep(s.medium, s.look, s.setting, upright, s.time)).light,
                          kTolerance)
                    << "V11 does nothing here";
                for (const SimdTarget target : simdTargets())
                    EXPECT_LE(differenceOf(truth, fast(s, target)).light, kTolerance)
                        << static_cast<int>(kind) << lamp << ' ' << degrees << ' '
                        << static_cast<int>(target);
            }
}

// Pixels much smaller than voxels and texels: kernels load what is around a packet once (kernel_block.h). In
// the middle, at faces and corners of the grid; and of values too far apart for their differences to be
// halves.
TEST(MediumSweep, agreesFromNear) {
    for (const bool wide : {false, true}) {
        Scene scene = sceneOf(Kind::Ramp, MediumModel::Indirect, false, true, 21);
        scene.setting.shadingWidth = 0;  // between places: sweep_shading_test.cpp
        if (wide) {
            auto field = makeField({19, 17, 15}, 2.0, {0.3, -0.2, 0.1}, [](const glm::ivec3& v) {
                return 32000 * std::sin(2.1 * v.x) * std::cos(1.9 * v.y + 1) * std::sin(1.7 * v.z + 2);
            });
            std::mt19937 random(5);
            MediumTransfer transfer({{-40000, randomMaterial(random, 1)}, {40000, randomMaterial(random, 1)}},
                                    0.3, "test");
            transfer.setSurfaceRamp(2000, 400000, "test");
            scene.medium = Medium(field, transfer);
        }
        const WorldBox& box = scene.medium.bounds();
        const glm::dvec3 ahead = scene.eyes[0].forward;
        for (const glm::dvec3& share : {glm::dvec3(0.5, 0.5, 0.5), glm::dvec3(0.02, 0.5, 0.5),
                                        glm::dvec3(0.97, 0.95, 0.5), glm::dvec3(0.04, 0.97, 0.96)}) {
            const glm::dvec3 target = glm::mix(box.low, box.high, share);
            for (EyeView& eye : scene.eyes) eye = viewFrom(target - 4.0 * ahead, target, 0.02, 27, 21);
            const std::vector<MediumPicture> truth = plain(scene);
            for (const SimdTarget simd : simdTargets()) {
                const Difference d = differenceOf(truth, fast(scene, simd));
                EXPECT_GT(d.brightest, 1e-3);
                EXPECT_LE(d.light, kTolerance) << static_cast<int>(simd) << ' ' << share.x << ' ' << wide;
            }
        }
    }
}

TEST(MediumSweep, doesNotDependOnTheThreadCount) {
    const int before = threadCount();
    for (const Kind kind : {Kind::Grid, Kind::Noise})
        for (const bool forward : {true, false}) {
            const Scene scene = sceneOf(kind, MediumModel::Indirect, false, forward, 3);
            setThreadCount(1);
            const std::vector<MediumPicture> one = fast(scene, SimdTarget::Auto);
            for (const int threads : {2, 3}) {
                setThreadCount(threads);
                const Difference d = differenceOf(one, fast(scene, SimdTarget::Auto));
                EXPECT_EQ(d.light, 0) << threads;
                EXPECT_EQ(d.depths, 0) << threads;
            }
        }
    setThreadCount(before);
}

TEST(MediumSweep, keepsNothingOfTheFrameBefore) {
    const Scene scene = sceneOf(Kind::Grid, MediumModel::Indirect, false, true, 4);
    Scene other = sceneOf(Kind::Grid, MediumModel::Indirect, true, false, 5);
    other.setting.lightSize = 40;
    MediumSweep sweep(scene.medium);
    std::vector<MediumPicture> first(2), second(2);
    sweep.render(scene.look, scene.setting, scene.eyes, scene.eyes[0].head, 0, first);
    sweep.render(other.look, other.setting, other.eyes, other.eyes[0].head, 0, second);
    sweep.render(scene.look, scene.setting, scene.eyes, scene.eyes[0].head, 0, second);
    EXPECT_EQ(differenceOf(first, second).light, 0);
    EXPECT_GT(sweep.heldBytes(), 1000u);
}

// W12: rays that start where something was found see the same; beyond it, less.
TEST(MediumSweep, startsWhereItIsTold) {
    for (const bool forward : {true, false}) {
        const Scene scene = sceneOf(Kind::Grid, MediumModel::Indirect, false, forward, 6);
        MediumSweep sweep(scene.medium);
        std::vector<MediumPicture> whole(2), started(2);
        sweep.render(scene.look, scene.setting, scene.eyes, scene.eyes[0].head, 0, whole);
        std::vector<Plane<float>> depths{whole[0].viewDepth, whole[1].viewDepth};
        sweep.render(scene.look, scene.setting, scene.eyes, scene.eyes[0].head, 0, started, depths);
        EXPECT_LE(differenceOf(whole, started).light, 1e-6);
        for (auto& plane : depths)
            for (int y = 0; y < plane.height(); ++y)
                for (int x = 0; x < plane.width(); ++x) plane.at(x, y) = 4.5f;
        sweep.render(scene.look, scene.setting, scene.eyes, scene.eyes[0].head, 0, started, depths);
        int nearer = 0;
        for (int x = 0; x < 27; ++x) {
            nearer += whole[0].viewDepth.at(x, 10) < 4.3f;
            EXPECT_GT(started[0].viewDepth.at(x, 10), 4.3f);
            EXPECT_GE(started[0].light.at(x, 10).w, whole[0].light.at(x, 10).w);
        }
        EXPECT_GT(nearer, 5);
        depths[1].resize(3, 3);
        EXPECT_THROW(
            sweep.render(scene.look, scene.setting, scene.eyes, scene.eyes[0].head, 0, started, depths),
            Error);
    }
}

TEST(MediumSweep, showsNothingOfAnEmptyMedium) {
    const Scene scene = sceneOf(Kind::Grid, MediumModel::Indirect, false, true, 8);
    const Medium empty;
    for (const SimdTarget target : simdTargets()) {
        MediumSweep sweep(empty, target);
        std::vector<MediumPicture> pictures(2);
        sweep.render(scene.look, scene.setting, scene.eyes, scene.eyes[0].head, 0, pictures);
        for (int y = 0; y < 21; ++y)
            for (int x = 0; x < 27; ++x) {
                ASSERT_EQ(pictures[1].light.at(x, y), glm::vec4(0, 0, 0, 1));
                ASSERT_EQ(pictures[1].viewDepth.at(x, y), kMissDepth);
            }
    }
}

}  // namespace
}  // namespace stereonav
