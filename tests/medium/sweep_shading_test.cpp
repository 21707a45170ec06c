// Surfaces shaded at places and between them, against those shaded at each sample.
#include <limits>

#include "engine/base/parallel.h"
#include "engine/medium/sweep/medium_sweep.h"
#include "engine/simd/simd_target.h"
#include "sweep_scenes.h"

namespace stereonav {
namespace {

using test::makeField;
using test::sun;
using test::viewFrom;

constexpr int kVoxels = 33;
constexpr double kLength = 2, kVoxel = kLength / (kVoxels - 1);  // metres

enum class Shape { Ball, Block, Same };

std::shared_ptr<GreyVolume> fieldOf(Shape shape) {
    return makeField(glm::ivec3(kVoxels), kLength, {0, 0, 0}, [&](const glm::ivec3& v) {
        const glm::dvec3 at = glm::dvec3(v) - 0.5 * (kVoxels - 1);
        if (shape == Shape::Same) return 1000.0;
        if (shape == Shape::Block)
            return std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) < 9 ? 1000.0 : 0.0;
        return 1000 * glm::smoothstep(0.0, 1.0, (14 - glm::length(at)) / 6);
    });
}

// The surface weight: by the value, or growing with the gradient too.
enum class Weight { Column, Ramp };

Medium mediumOf(Shape shape, Weight weight) {
    MediumMaterial none, skin, inner;
    skin.color = {0.9f, 0.6f, 0.4f};
    skin.opacity = 0.8;
    skin.transport = {0.9f, 0.7f, 0.6f};
    skin.surface = 1;
    inner = skin;
    inner.surface = 0.5;
    MediumTransfer transfer({{-1, none}, {250, none}, {500, skin}, {1000, inner}}, 0.1, "test");
    if (weight == Weight::Ramp) transfer.setSurfaceRamp(200, 2000, "test");
    return Medium(fieldOf(shape), transfer);
}

struct ShadedScene {
    Medium medium;
    MediumLook look;
    SweepSetting setting;
    EyeView eye;
};

// A scene whose pixels are `pixel` voxels wide at the medium's middle; the light comes over the viewer's
// shoulder or from behind the medium.
ShadedScene sceneOf(Shape shape, Weight weight, double pixel, bool forward, int width = 50, int height = 37) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(-0.5, 0.7, -0.4));
    const double half = 0.5 * width * pixel * kVoxel / 4;
    // To the surface, so that it fills narrow views.
    const glm::dvec3 target = shape == Shape::Ball ? glm::dvec3(0.2, 0.1, 0.6) : glm::dvec3(0.1, 0.2, 0.5);
    ShadedScene s{mediumOf(shape, weight), {}, {}, viewFrom(target - 4.0 * way, target, half, width, height)};
    s.look.light = sun(glm::normalize((forward ? 1.0 : -1.0) * way + glm::dvec3(0.3, 0.2, -0.4)));
    s.look.light.radiance = glm::vec3(0.4f);
    s.setting.slices = 60;
    s.setting.lightSize = 32;
    return s;
}

Plane<glm::vec4> lightOf(const ShadedScene& scene, double shadingWidth,
                         SimdTarget target = SimdTarget::Auto) {
    MediumSweep sweep(scene.medium, target);
    SweepSetting setting = scene.setting;
    setting.shadingWidth = shadingWidth;
    MediumPicture picture;
    sweep.render(scene.look, setting, {&scene.eye, 1}, scene.eye.head, 0, {&picture, 1});
    return picture.light;
}

struct ShadingError {
    double rms = 0, worst = 0;
};
ShadingError errorOf(const Plane<glm::vec4>& truth, const Plane<glm::vec4>& picture) {
    ShadingError e;
    for (int y = 0; y < truth.height(); ++y)
        for (int x = 0; x < truth.width(); ++x)
            for (int k = 0; k < 4; ++k) {
                const double d = std::abs(truth.at(x, y)[k] - picture.at(x, y)[k]);
                e.worst = d <= e.worst ? e.worst : d;  // NaN is kept
                e.rms += d * d / (4.0 * truth.width() * truth.height());
            }
    e.rms = std::sqrt(e.rms);
    return e;
}

float brightestOf(const Plane<glm::vec4>& light) {
    float most = 0;
    for (int y = 0; y < light.height(); ++y)
        for (int x = 0; x < light.width(); ++x) most = std::max(most, light.at(x, y).x);
    return most;
}

// Bounds by the voxels to a pixel; light is up to about 0.6.
struct Bound {
    double pixel, rms, worst;
};

TEST(SweepShading, betweenPlacesIsNearlyAsAtEachSample) {
    struct Case {
        Shape shape;
        Weight weight;
        std::vector<Bound> bounds;
    };
    const std::vector<Bound> edges{{0.03, 5e-4, 3e-3}, {0.15, 1.5e-3, 0.02}, {0.4, 4e-3, 0.08}};
    const std::vector<Case> cases{
        {Shape::Ball, Weight::Ramp, {{0.03, 1e-5, 1e-4}, {0.15, 1e-4, 1e-3}, {0.4, 5e-4, 0.01}}},
        {Shape::Block, Weight::Column, edges},
        {Shape::Block, Weight::Ramp, edges}};
    for (const Case& c : cases)
        for (const Bound& bound : c.bounds)
            for (const bool forward : {true, false}) {
                const ShadedScene scene = sceneOf(c.shape, c.weight, bound.pixel, forward);
                for (const SimdTarget target : simdTargets()) {
                    const Plane<glm::vec4> truth = lightOf(scene, 0, target);
                    const ShadingError e = errorOf(truth, lightOf(scene, 1, target));
                    EXPECT_LE(e.rms, bound.rms) << bound.pixel << forward;
                    EXPECT_LE(e.worst, bound.worst) << bound.pixel << forward;
                    EXPECT_GT(e.worst, 0) << "nothing is shaded between places";
                    EXPECT_GT(brightestOf(truth), 0.02);
                }
            }
}

// Places further apart than the width are not used: each sample is shaded itself then, to the bit.
TEST(SweepShading, isOfEachSampleWherePlacesLieFarApart) {
    const ShadedScene scene = sceneOf(Shape::Block, Weight::Ramp, 0.15, true);
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const SimdTarget target : simdTargets()) {
        const Plane<glm::vec4> truth = lightOf(scene, 0, target);
        for (const double width : {0.1, 1e-30, -1.0, none})
            EXPECT_EQ(errorOf(truth, lightOf(scene, width, target)).worst, 0) << width;
        EXPECT_GT(errorOf(truth, lightOf(scene, 0.5, target)).worst, 0);
    }
}

TEST(SweepShading, isSoundAtAnyWidth) {
    const ShadedScene coarse = sceneOf(Shape::Block, Weight::Column, 3, true);
    for (const SimdTarget target : simdTargets())
        for (const double width : {1e-3, 16.0, 1e30, std::numeric_limits<double>::infinity()}) {
            const Plane<glm::vec4> light = lightOf(coarse, width, target);
            EXPECT_LE(errorOf(lightOf(coarse, 0, target), light).worst, 0.5);
            EXPECT_LE(brightestOf(light), 1);
        }
}

// The eye inside the medium, in each of its octants' ways: places behind it and beyond the grid's faces.
TEST(SweepShading, isNearFromInside) {
    for (const Weight weight : {Weight::Column, Weight::Ramp})
        for (const double side : {-1.0, 1.0}) {
            ShadedScene scene = sceneOf(Shape::Ball, weight, 0.1, true);
            scene.eye = viewFrom({0.1, 0.2, 0.3}, {0.1 + side, 0.5, -side}, 0.4, 41, 35);
            for (const SimdTarget target : simdTargets()) {
                const ShadingError e = errorOf(lightOf(scene, 0, target), lightOf(scene, 1, target));
                EXPECT_LE(e.rms, 1e-3);
                EXPECT_LE(e.worst, 0.03);
            }
        }
}

TEST(SweepShading, holdsForALamp) {
    ShadedScene scene = sceneOf(Shape::Ball, Weight::Ramp, 0.15, true);
    scene.look.light.kind = MediumLight::Kind::Lamp;
    scene.look.light.position = scene.eye.eye + glm::dvec3(0.5, 0.3, 1);
    scene.look.light.direction = glm::normalize(-scene.look.light.position);
    for (const MediumModel model : {MediumModel::Surface, MediumModel::Direct, MediumModel::Indirect}) {
        scene.look.model = model;
        for (const SimdTarget target : simdTargets()) {
            const Plane<glm::vec4> truth = lightOf(scene, 0, target);
            const ShadingError e = errorOf(truth, lightOf(scene, 1, target));
            EXPECT_LE(e.rms, 2e-4);
            EXPECT_LE(e.worst, 3e-3);
            EXPECT_GT(brightestOf(truth), 0.02);
        }
    }
}

// Where nothing changes there is no gradient, and Blinn-Phong gives no light.
TEST(SweepShading, leavesWhatHasNoGradientDark) {
    const ShadedScene scene = sceneOf(Shape::Same, Weight::Column, 0.1, true);
    for (const SimdTarget target : simdTargets())
        EXPECT_LE(errorOf(lightOf(scene, 0, target), lightOf(scene, 1, target)).worst, 1e-7);
}

// Pictures that end within a patch or a packet.
TEST(SweepShading, isNearInPicturesOfAnySize) {
    for (const glm::ivec2& size :
         {glm::ivec2(1, 1), glm::ivec2(17, 9), glm::ivec2(16, 8), glm::ivec2(3, 40)}) {
        const ShadedScene scene = sceneOf(Shape::Ball, Weight::Ramp, 0.15, true, size.x, size.y);
        for (const SimdTarget target : simdTargets())
            EXPECT_LE(errorOf(lightOf(scene, 0, target), lightOf(scene, 1, target)).worst, 1e-3) << size.x;
    }
}

TEST(SweepShading, doesNotDependOnTheThreadCount) {
    const int before = threadCount();
    const ShadedScene scene = sceneOf(Shape::Block, Weight::Ramp, 0.15, false);
    setThreadCount(1);
    const Plane<glm::vec4> one = lightOf(scene, 1);
    setThreadCount(3);
    EXPECT_EQ(errorOf(one, lightOf(scene, 1)).worst, 0);
    setThreadCount(before);
}

}  // namespace
}  // namespace stereonav
