// The packet casters against the plain one, pixel by pixel, on every instruction set of this machine.
#include "engine/volume/volume_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <random>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/camera/stereo_rig.h"
#include "tests/oracle/plain_composite.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

using test::channelDifference;

VolumeFrame frameOf(const glm::ivec3& size, const glm::dvec3& spacing,
                    const glm::dquat& turn = {1, 0, 0, 0}) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = spacing;
    frame.axes = glm::mat3_cast(turn);
    frame.origin = {0.02, -0.03, 0.01};
    return frame;
}

// A tube along k with wavy walls and some noise: -1000 inside, 40 outside.
GreyVolume wavyTube(const VolumeFrame& frame, double noise) {
    GreyVolume volume(frame);
    std::mt19937 random(7);
    std::normal_distribution<double> jitter;
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                const glm::dvec2 middle(0.5 * frame.size.x + 4 * std::sin(k * 0.11),
                                        0.5 * frame.size.y + 3 * std::cos(k * 0.07));
                const double radius = 9 + 2.5 * std::sin(k * 0.5);
                const double outside = glm::length(glm::dvec2(i, j) - middle) - radius;
                const double value = -480 + 520 * std::tanh(outside * 0.8) + noise * jitter(random);
                volume.at(i, j, k) = static_cast<std::int16_t>(std::lround(value));
            }
    return volume;
}

VolumeScene sceneOf(GreyVolume field, double isovalue) {
    VolumeScene scene;
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = static_cast<float>(isovalue);
    Progress progress;
    scene.field = std::move(field);
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    return scene;
}

Lens lensOf(int width, int height, double nearDepth) {
    Lens lens;
    lens.width = width;
    lens.height = height;
    lens.verticalFov = 1.5;
    lens.nearDepth = nearDepth;
    return lens;
}

Pose randomPose(std::mt19937& random, const VolumeFrame& frame, const glm::dvec3& voxel) {
    std::normal_distribution<double> normal;
    Pose pose;
    pose.position = frame.worldFromVoxel(voxel);
    pose.orientation =
        glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
    return pose;
}

EyeImage rendered(const VolumeRenderer& renderer, const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, image);
    return image;
}

struct Agreement {
    long long pixels = 0, hits = 0, otherHits = 0;
    double worst = 0;  // relative difference of depths where both hit the same place
};

// Depths that differ by more than this share are hits of another place: a ray that grazes the surface within
// the rounding of single precision.
constexpr double kOtherPlace = 1e-4;

void compareDepths(const VolumeScene& scene, const EyeView& view, const EyeImage& image, Agreement& sum) {
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const PlainHit hit =
                castPlainVolume(scene.field, scene.cells.isovalue,
                                {view.eye, view.rayDirection(x + 0.5, y + 0.5), view.nearDepth});
            const double fast = image.viewDepth.at(x, y);
            ++sum.pixels;
            sum.hits += hit.hit();
            if (std::isinf(fast) && !hit.hit()) continue;
            const double difference = std::abs(fast - hit.t) / hit.t;
            if (!(difference < kOtherPlace))
                ++sum.otherHits;
            else
                sum.worst = std::max(sum.worst, difference);
        }
}

struct Case {
    const char* name;
    VolumeFrame frame;
    double noise;
};

std::vector<Case> cases() {
    return {
        {"cubes", frameOf({40, 36, 70}, glm::dvec3(0.0008)), 0},
        {"flat voxels", frameOf({40, 36, 70}, {0.0008, 0.0007, 0.0025}), 0},
        {"very flat voxels", frameOf({40, 36, 40}, {0.0005, 0.0005, 0.01}), 0},
        {"turned",
         frameOf({40, 36, 70}, {0.0008, 0.0009, 0.0007}, glm::normalize(glm::dquat(0.9, 0.2, -0.3, 0.4))), 0},
        {"noise", frameOf({40, 36, 70}, {0.0008, 0.0008, 0.0007}), 60}};
}

TEST(VolumeRenderer, HitsWhatThePlainWalkHitsFromWithin) {
    Agreement sum;
    for (const Case& c : cases()) {
        const VolumeScene scene = sceneOf(wavyTube(c.frame, c.noise), -480);
        std::mt19937 random(3);
        for (int n = 0; n < 4; ++n) {
            const glm::dvec3 voxel(20 + 4 * std::sin(20 * 0.11) + n, 18 + 3 * std::cos(20 * 0.07), 20 + n);
            const EyeView view = makeEyeView(randomPose(random, c.frame, voxel), lensOf(37, 29, 0.0002));
            for (const SimdTarget target : simdTargets()) {
                const VolumeRenderer renderer(scene, {target});
                compareDepths(scene, view, rendered(renderer, view), sum);
            }
        }
    }
    std::printf("%lld pixels, %lld hits, %lld of another place, worst relative difference %.2g\n", sum.pixels,
                sum.hits, sum.otherHits, sum.worst);
    EXPECT_GT(sum.hits, sum.pixels / 2);
    EXPECT_LE(sum.otherHits, sum.pixels / 10000);
    EXPECT_LT(sum.worst, 2e-5);
}

// Rays from outside begin in what is below the isovalue, as scenes see to it.
GreyVolume closedAtTheFaces(GreyVolume volume) {
    const glm::ivec3 last = volume.frame.size - 1;
    for (int k = 0; k <= last.z; ++k)
        for (int j = 0; j <= last.y; ++j)
            for (int i = 0; i <= last.x; ++i)
                if (i == 0 || j == 0 || k == 0 || i == last.x || j == last.y || k == last.z)
                    volume.at(i, j, k) = -1000;
    return volume;
}

TEST(VolumeRenderer, HitsWhatThePlainWalkHitsFromOutside) {
    Agreement sum;
    for (const Case& c : cases()) {
        const VolumeScene scene = sceneOf(closedAtTheFaces(wavyTube(c.frame, c.noise)), -480);
        std::mt19937 random(5);
        for (int n = 0; n < 4; ++n) {
            // The tube's ends are open at the volume's faces.
            Pose pose;
            const glm::dvec3 middle = c.frame.worldFromVoxel(0.5 * glm::dvec3(c.frame.size - 1));
            std::normal_distribution<double> normal;
            const glm::dvec3 away = glm::normalize(glm::dvec3(normal(random), normal(random), 2.0));
            pose.position = middle + 0.3 * away;
            const glm::dvec3 right = glm::normalize(glm::cross(away, glm::dvec3(0.1, 1, 0)));
            pose.orientation = glm::quat_cast(glm::dmat3(right, glm::cross(away, right), away));
            Lens lens = lensOf(41, 31, 0.001);
            lens.verticalFov = 0.3;
            const EyeView view = makeEyeView(pose, lens);
            for (const SimdTarget target : simdTargets())
                compareDepths(scene, view, rendered(VolumeRenderer(scene, {target}), view), sum);
        }
    }
    std::printf("%lld pixels, %lld hits, %lld of another place, worst relative difference %.2g\n", sum.pixels,
                sum.hits, sum.otherHits, sum.worst);
    EXPECT_GT(sum.hits, sum.pixels / 20);
    EXPECT_LE(sum.otherHits, sum.pixels / 5000);
    EXPECT_LT(sum.worst, 2e-5);
}

TEST(VolumeRenderer, LeapingChangesNothing) {
    for (const Case& c : cases()) {
        const VolumeScene scene = sceneOf(wavyTube(c.frame, c.noise), -480);
        std::mt19937 random(11);
        const EyeView view = makeEyeView(randomPose(random, c.frame, {23, 17, 20}), lensOf(64, 48, 0.0002));
        for (const SimdTarget target : simdTargets()) {
            const EyeImage leaping = rendered(VolumeRenderer(scene, {target, true}), view);
            const EyeImage walking = rendered(VolumeRenderer(scene, {target, false}), view);
            int different = 0;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const float a = leaping.viewDepth.at(x, y), b = walking.viewDepth.at(x, y);
                    if (a == b) continue;
                    // Where a leap ends within rounding of a cell's face, the ray may go around a corner by
                    // the other cell.
                    ++different;
                    EXPECT_NEAR(a, b, 1e-5f * b) << c.name << " " << x << "," << y;
                }
            EXPECT_LE(different, 2) << c.name;
        }
    }
}

TEST(VolumeRenderer, ScatteredPixelsAreThoseOfThePicture) {
    for (const Case& c : cases()) {
        const VolumeScene scene = sceneOf(wavyTube(c.frame, c.noise), -480);
        std::mt19937 random(13);
        const EyeView view = makeEyeView(randomPose(random, c.frame, {23, 17, 20}), lensOf(96, 80, 0.0002));
        for (const SimdTarget target : simdTargets()) {
            const VolumeRenderer renderer(scene, {target});
            const EyeImage whole = rendered(renderer, view);
            EyeImage some;
            some.resize(view.width, view.height, renderer.viewDependence());
            std::vector<PixelIndex> pixels;
            for (int y = 0; y < view.height; ++y)
                for (int x = 32; x < 64; ++x)
                    if (random() % 3 == 0)
                        pixels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
            renderer.renderPixels(view, {32, 0, 64, view.height}, pixels, some);
            for (const PixelIndex p : pixels) {
                ASSERT_EQ(some.viewDepth.at(p.x, p.y), whole.viewDepth.at(p.x, p.y)) << c.name;
                ASSERT_EQ(some.color.at(p.x, p.y), whole.color.at(p.x, p.y)) << c.name;
                ASSERT_EQ(some.normal.at(p.x, p.y), whole.normal.at(p.x, p.y)) << c.name;
            }
        }
    }
}

TEST(VolumeRenderer, ShadesAsThePlainShader) {
    for (const Case& c : cases()) {
        if (c.noise > 0) continue;
        VolumeScene scene = sceneOf(wavyTube(c.frame, c.noise), -480);
        scene.look.specular = 0.4f;
        std::mt19937 random(17);
        const StereoViews views =
            makeStereoViews(randomPose(random, c.frame, {23, 17, 20}), lensOf(48, 40, 0.0002), {0.001, 0.02});
        for (const SimdTarget target : simdTargets()) {
            const EyeImage image = rendered(VolumeRenderer(scene, {target}), views.right);
            for (int y = 0; y < 40; ++y)
                for (int x = 0; x < 48; ++x) {
                    const double t = image.viewDepth.at(x, y);
                    if (!(t < kMissDepth)) continue;
                    const glm::dvec3 world = views.right.pointAt(x + 0.5, y + 0.5, t);
                    const glm::dvec3 normal =
                        plainNormal(scene.field, scene.cells.frame.voxelFromWorld(world));
                    const glm::dvec3 light = shadePlain(scene.look, world, normal, views.right.head,
                                                        views.right.eye, glm::dvec3(scene.look.surface));
                    // Corner normals are kept to 10 bits, mixed with 15-bit weights.
                    ASSERT_LE(channelDifference(image.color.at(x, y), packColor(glm::vec3(light))), 6)
                        << c.name << " " << x << "," << y;
                }
        }
    }
}

TEST(VolumeRenderer, ShadingAgainGivesTheSamePicture) {
    const Case c = cases()[0];
    const VolumeScene scene = sceneOf(wavyTube(c.frame, 0), -480);
    std::mt19937 random(19);
    const EyeView view = makeEyeView(randomPose(random, c.frame, {23, 17, 20}), lensOf(50, 40, 0.0002));
    for (const SimdTarget target : simdTargets()) {
        const VolumeRenderer renderer(scene, {target});
        const EyeImage image = rendered(renderer, view);
        EyeImage again = image;
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < 50; ++x) again.color.at(x, y) = 0;
            renderer.shadeAgain(view, y, 0, 50, again);
            for (int x = 0; x < 50; ++x)  // from normals of 10 bits
                ASSERT_LE(channelDifference(image.color.at(x, y), again.color.at(x, y)), 4) << x << "," << y;
        }
    }
}

VolumeScene glassTube(const VolumeFrame& frame, double opacity) {
    VolumeScene scene;
    scene.field = wavyTube(frame, 0);
    scene.look.transfer =
        TransferFunction({{-630, {0.8f, 0.3f, 0.2f}, 0}, {-330, {0.8f, 0.6f, 0.4f}, opacity}}, 0.001, "test");
    SurfaceSetting setting;
    setting.isovalue = -480;
    setting.lowest = -630;
    setting.highest = 32767;
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    return scene;
}

TEST(VolumeRenderer, CompositesAsThePlainCompositor) {
    for (const double opacity : {0.05, 0.95, 1.0}) {
        const VolumeFrame frame = frameOf({40, 36, 70}, {0.0008, 0.0008, 0.0007});
        const VolumeScene scene = glassTube(frame, opacity);
        std::mt19937 random(23);
        const EyeView view = makeEyeView(randomPose(random, frame, {23, 17, 20}), lensOf(40, 36, 0.0002));
        for (const SimdTarget target : simdTargets()) {
            const VolumeRenderer renderer(scene, {target});
            const EyeImage image = rendered(renderer, view);
            long long sum = 0;
            int large = 0;
            for (int y = 0; y < 36; ++y)
                for (int x = 0; x < 40; ++x) {
                    const PlainComposite truth =
                        compositePlain(scene.field, scene.look,
                                       {view.eye, view.rayDirection(x + 0.5, y + 0.5), 0.0}, view.head, 0.5);
                    const int difference =
                        channelDifference(image.color.at(x, y), packColor(glm::vec3(truth.color)));
                    sum += difference;
                    large += difference > 12;
                    // A sample more or less at the end, of less than 1/1024 of the light.
                    EXPECT_NEAR(image.depthSpread.at(x, y), truth.spread, 0.02 * truth.spread + 1e-5)
                        << opacity << " " << x << " " << y;
                }
            std::printf("opacity %g: mean difference %g steps of 1023, %d above 12\n", opacity, sum / 1440.0,
                        large);
            EXPECT_LT(sum, 40 * 36) << opacity;
            EXPECT_EQ(large, 0) << opacity;
        }
    }
}

// Values that are smooth, go from nothing to all, and differ along each axis.
std::shared_ptr<Volume<std::uint8_t>> waves(const VolumeFrame& frame) {
    auto volume = std::make_shared<Volume<std::uint8_t>>(frame);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                volume->at(i, j, k) = static_cast<std::uint8_t>(127.5 + 127.4 * std::sin(0.5 * i + 0.9 * j) *
                                                                            std::cos(0.7 * k));
    return volume;
}

TEST(VolumeRenderer, ModulatesOpacityAsThePlainCompositor) {
    const VolumeFrame frame = frameOf({40, 36, 70}, {0.0008, 0.0008, 0.0007});
    VolumeScene scene = glassTube(frame, 0.95);
    std::mt19937 random(31);
    const EyeView view = makeEyeView(randomPose(random, frame, {23, 17, 20}), lensOf(40, 36, 0.0002));
    const EyeImage plain = rendered(VolumeRenderer(scene), view);
    scene.look.modulation = waves(frame);
    for (const SimdTarget target : simdTargets()) {
        const EyeImage image = rendered(VolumeRenderer(scene, {target}), view);
        long long sum = 0, changed = 0;
        for (int y = 0; y < 36; ++y)
            for (int x = 0; x < 40; ++x) {
                const PlainComposite truth =
                    compositePlain(scene.field, scene.look,
                                   {view.eye, view.rayDirection(x + 0.5, y + 0.5), 0.0}, view.head, 0.5);
                const int difference =
                    channelDifference(image.color.at(x, y), packColor(glm::vec3(truth.color)));
                sum += difference;
                changed += channelDifference(image.color.at(x, y), plain.color.at(x, y)) > 30;
                ASSERT_LE(difference, 12) << x << " " << y;
            }
        EXPECT_LT(sum, 40 * 36);
        EXPECT_GT(changed, 200) << "what is compared differs from what is not modulated";
    }
}

TEST(VolumeRenderer, FullModulationChangesNothingAndNoneLeavesNothing) {
    const VolumeFrame frame = frameOf({40, 36, 70}, {0.0008, 0.0008, 0.0007});
    VolumeScene scene = glassTube(frame, 0.95);
    std::mt19937 random(37);
    const EyeView view = makeEyeView(randomPose(random, frame, {23, 17, 20}), lensOf(30, 20, 0.0002));
    const EyeImage plain = rendered(VolumeRenderer(scene), view);
    const auto modulation = std::make_shared<Volume<std::uint8_t>>(frame);
    scene.look.modulation = modulation;
    const EyeImage none = rendered(VolumeRenderer(scene), view);
    for (std::size_t n = 0; n < modulation->values.size(); ++n) modulation->values[n] = 255;
    const EyeImage full = rendered(VolumeRenderer(scene), view);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 30; ++x) {
            ASSERT_LE(channelDifference(full.color.at(x, y), plain.color.at(x, y)), 1) << x << " " << y;
            ASSERT_EQ(none.viewDepth.at(x, y), kMissDepth) << x << " " << y;
        }
    scene.look.modulation = std::make_shared<Volume<std::uint8_t>>(frameOf({40, 36, 69}, frame.spacing));
    EXPECT_THROW(VolumeRenderer{scene}, Error);
}

TEST(VolumeRenderer, StartingFromAKnownDepthChangesNothing) {
    const VolumeFrame frame = frameOf({40, 36, 70}, {0.0008, 0.0008, 0.0007});
    const VolumeScene scene = glassTube(frame, 0.95);
    std::mt19937 random(29);
    const EyeView view = makeEyeView(randomPose(random, frame, {23, 17, 20}), lensOf(70, 40, 0.0002));
    for (const SimdTarget target : simdTargets()) {
        const VolumeRenderer renderer(scene, {target});
        const EyeImage image = rendered(renderer, view);
        EyeImage again = image;
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 70; ++x) {
                float& depth = again.viewDepth.at(x, y);
                if (depth < kMissDepth) depth = (x + y) % 3 == 0 ? 0.0f : depth * 0.98f;
            }
        for (int tile = 0; tile < renderer.tileCount(view); ++tile)
            renderer.renderTileFromDepth(view, tile, again);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 70; ++x) {
                ASSERT_EQ(again.color.at(x, y), image.color.at(x, y)) << x << "," << y;
                ASSERT_EQ(again.viewDepth.at(x, y), image.viewDepth.at(x, y)) << x << "," << y;
            }
    }
}

TEST(VolumeRenderer, WhatLiesBeyondTheEdgeIsNotMissed) {
    const Case c = cases()[0];
    const VolumeScene scene = sceneOf(wavyTube(c.frame, 0), -480);
    std::mt19937 random(31);
    int free = 0;
    for (int n = 0; n < 6; ++n) {
        const StereoViews views = makeStereoViews(randomPose(random, c.frame, {23, 17, 20}),
                                                  lensOf(96, 64, 0.0002), {0.001, 0.006});
        const VolumeRenderer renderer(scene);
        const EyeImage image = rendered(renderer, views.right);
        const double column = 96 + views.shiftAtInfinity;
        for (int y = 0; y < 64; y += 8)
            for (int x = 0; x < 96; x += 16) {
                if (renderer.mayHitBeyondEdge(views.right, {x, y, x + 16, y + 8}, column,
                                              views.parallaxScale))
                    continue;
                ++free;
                for (int v = y; v < y + 8; ++v)
                    for (int u = x; u < x + 16; ++u)
                        ASSERT_GE(image.viewDepth.at(u, v),
                                  views.parallaxScale / (column - (u + 1)) * (1 - 1e-6));
            }
    }
    EXPECT_GT(free, 20);
}

TEST(VolumeRenderer, ThreadsChangeNothing) {
    const Case c = cases()[4];
    const VolumeScene scene = sceneOf(wavyTube(c.frame, c.noise), -480);
    std::mt19937 random(37);
    const EyeView view = makeEyeView(randomPose(random, c.frame, {23, 17, 20}), lensOf(200, 150, 0.0002));
    const int threads = threadCount();
    const VolumeRenderer renderer(scene);
    setThreadCount(1);
    const EyeImage one = rendered(renderer, view);
    setThreadCount(3);
    const EyeImage three = rendered(renderer, view);
    setThreadCount(threads);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            ASSERT_EQ(one.color.at(x, y), three.color.at(x, y));
            ASSERT_EQ(one.viewDepth.at(x, y), three.viewDepth.at(x, y));
        }
}

}  // namespace
}  // namespace stereonav
