// Translucent volumes have no rings: along a radius of a ball, whose values fall evenly, the picture differs
// from the integral along its rays (the plain compositor with very short steps) by less than what is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/sanitizers.h"
#include "engine/camera/stereo_rig.h"
#include "engine/volume/volume_renderer.h"
#include "tests/oracle/plain_composite.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

constexpr double kRingBall_m = 0.020;     // radius
constexpr double kRingSpacing_m = 0.001;  // between voxels
constexpr double kFallPerVoxel = 100;     // values that are lost, outwards
constexpr int kRingWidth = 120, kRingHeight = 5;
constexpr double kExactStep = 1.0 / 48;  // voxels
// The exact rays take nearly all of the time, and sanitizers have nothing to find in more of them.
constexpr bool kFewRays = kAddressSanitizer || kThreadSanitizer;

// A ball around the origin, 0 on its surface, more inside; cells: where the function shows something.
VolumeScene ringBall(const TransferFunction& transfer) {
    VolumeScene scene;
    VolumeFrame frame = test::slantedFrame(glm::ivec3(56), glm::dvec3(kRingSpacing_m));
    frame.origin = -(frame.axes * (0.5 * kRingSpacing_m * 55.0 * glm::dvec3(1)));
    scene.field = test::greyVolume(frame, [&](const glm::dvec3& voxel) {
        const double r = glm::length(frame.worldFromVoxel(voxel));
        return kFallPerVoxel * (kRingBall_m - r) / kRingSpacing_m;
    });
    scene.look.transfer = transfer;
    scene.look.falloff = 0;
    const TransferFunction::Range seen = transfer.visibleRange();
    SurfaceSetting setting;
    setting.lowest = static_cast<float>(std::max(seen.lowest, -32768.0));
    setting.highest = static_cast<float>(std::min(seen.highest, 32767.0));
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    return scene;
}

// A strip from before the ball's middle to beyond its edge, for both eyes.
StereoViews ringViews() {
    Lens lens;
    lens.width = kRingWidth;
    lens.height = kRingHeight;
    lens.nearDepth = 0.001;
    const double distance = 0.1;
    lens.verticalFov = 2 * std::atan(0.5 * kRingHeight * 1.2 * kRingBall_m / kRingWidth / distance);
    const Pose head = poseFromAngles({0.55 * kRingBall_m, -distance, 0.0013}, 0, 0, 0);
    return makeStereoViews(head, lens, {0.003, distance});
}

double levelOf(PackedColor color, int shift) {
    return (color >> shift & 1023u) * (255.0 / 1023);
}

// Channels of a row, in levels of 255.
using RowLevels = std::vector<double>;

struct RingRow {
    RowLevels channels[3];
};

RingRow exactRow(const VolumeScene& scene, const EyeView& view) {
    RingRow row;
    for (int x = 0; x < view.width; ++x) {
        const PlainRay ray{view.eye, view.rayDirection(x + 0.5, kRingHeight / 2 + 0.5), view.nearDepth};
        const PlainComposite truth = compositePlain(scene.field, scene.look, ray, view.head, kExactStep);
        for (int c = 0; c < 3; ++c)
            row.channels[c].push_back(255 * std::sqrt(std::clamp(truth.color[c], 0.0, 1.0)));
    }
    return row;
}

struct Bands {
    double worst = 0;  // levels of 255: difference less its mean around
    double error = 0;  // levels of 255: difference
};

// Differences of a row: how far they stray from their mean over some pixels around, which a ring is as wide
// as.
Bands bandsOf(const VolumeRenderer& renderer, const EyeView& view, const RingRow& truth) {
    constexpr int kAround = 5;  // pixels to each side
    EyeImage image;
    image.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, image);
    Bands bands;
    for (int c = 0; c < 3; ++c) {
        RowLevels difference;
        for (int x = 0; x < view.width; ++x)
            difference.push_back(levelOf(image.color.at(x, kRingHeight / 2), 10 * c) -
                                 truth.channels[c][static_cast<std::size_t>(x)]);
        for (int x = 0; x < view.width; ++x) {
            const int from = std::max(x - kAround, 0), to = std::min(x + kAround + 1, view.width);
            double mean = 0;
            for (int n = from; n < to; ++n) mean += difference[static_cast<std::size_t>(n)] / (to - from);
            bands.worst = std::max(bands.worst, std::abs(difference[static_cast<std::size_t>(x)] - mean));
            bands.error = std::max(bands.error, std::abs(difference[static_cast<std::size_t>(x)]));
        }
    }
    return bands;
}

VolumeCasting integrated(SimdTarget target) {
    VolumeCasting casting;
    casting.target = target;
    casting.integrated = true;
    return casting;
}

struct RingCase {
    const char* name;
    TransferFunction transfer;
};

// A film at the surface, as wall_glass has it, and a ramp of opacity and colour, as tissue has it at the edge
// of a mask.
std::vector<RingCase> ringCases() {
    const glm::vec3 pale(0.9f, 0.8f, 0.5f), flesh(0.6f, 0.1f, 0.06f);
    const auto made = [](const char* name, std::vector<TransferPoint> points, double length) {
        return RingCase{name, TransferFunction(std::move(points), length, name)};
    };
    return {
        made("film", {{10, pale, 0}, {40, pale, 0.35}, {70, flesh, 0.05}, {400, flesh, 0.1}}, 0.001),
        made("ramp", {{0, pale, 0}, {36, pale, 0.15}, {48, pale, 0.15}, {60, flesh, 0.55}, {76, flesh, 0.65}},
             0.002)};
}

TEST(Rings, WhatIsIntegratedHasNone) {
    for (const RingCase& c : ringCases()) {
        const VolumeScene scene = ringBall(c.transfer);
        const StereoViews views = ringViews();
        for (const EyeView* view : {&views.left, &views.right}) {
            if (kFewRays && view == &views.right) continue;
            const RingRow truth = exactRow(scene, *view);
            for (const SimdTarget target : simdTargets()) {
                const Bands sampled = bandsOf(VolumeRenderer(scene, {target}), *view, truth);
                const Bands bands = bandsOf(VolumeRenderer(scene, integrated(target)), *view, truth);
                std::printf("%s, %s: bands of %.2f levels, samples of %.2f; errors %.2f, %.2f\n", c.name,
                            std::string(nameOf(target)).c_str(), bands.worst, sampled.worst, bands.error,
                            sampled.error);
                EXPECT_LT(bands.worst, 2) << c.name;
                EXPECT_GT(sampled.worst, 2) << c.name << ": what is compared is no easy case";
            }
        }
    }
}

// Eyes without, and within the ball's inside.
std::vector<EyeView> smallViews() {
    Lens lens;
    lens.width = kFewRays ? 5 : 9;
    lens.height = kFewRays ? 3 : 5;
    lens.verticalFov = 0.6;
    lens.nearDepth = 0.0005;
    return {makeEyeView(poseFromAngles({0.003, -0.06, 0.002}, 0, 0, 0), lens),
            makeEyeView(poseFromAngles({0.004, -0.012, 0.002}, 30, 10, 0), lens)};
}

// Functions at the ends of what they may be: of one value, opaque, of a step, of values that no voxel has.
std::vector<RingCase> extremeCases() {
    const glm::vec3 pale(0.9f, 0.8f, 0.5f), flesh(0.6f, 0.1f, 0.06f);
    const auto made = [](const char* name, std::vector<TransferPoint> points) {
        return RingCase{name, TransferFunction(std::move(points), 0.001, name)};
    };
    return {made("one value", {{100, pale, 0.02}}), made("opaque", {{-50, pale, 0}, {50, flesh, 1}}),
            made("a step", {{100, pale, 0}, {100.0005, pale, 0.1}}),
            made("a peak", {{190, flesh, 0}, {200, flesh, 0.9}, {210, flesh, 0}}),
            made("far values", {{-1e9, pale, 0}, {1e9, flesh, 0.1}})};
}

TEST(Rings, ExtremeFunctionsAreIntegratedAsThePlainCompositorDoes) {
    for (const RingCase& c : extremeCases()) {
        const VolumeScene scene = ringBall(c.transfer);
        for (const EyeView& view : smallViews()) {
            RowLevels truths;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const PlainRay ray{view.eye, view.rayDirection(x + 0.5, y + 0.5), view.nearDepth};
                    const PlainComposite truth =
                        compositePlain(scene.field, scene.look, ray, view.head, kExactStep);
                    truths.push_back(255 * std::sqrt(std::clamp(truth.color.x, 0.0, 1.0)));
                }
            for (const SimdTarget target : simdTargets()) {
                EyeImage image;
                const VolumeRenderer renderer(scene, integrated(target));
                image.resize(view.width, view.height, renderer.viewDependence());
                renderEye(renderer, view, image);
                double worst = 0;
                for (int y = 0; y < view.height; ++y)
                    for (int x = 0; x < view.width; ++x) {
                        ASSERT_TRUE(image.depthSpread.at(x, y) >= 0) << c.name;
                        const auto n = static_cast<std::size_t>(y * view.width + x);
                        worst = std::max(worst, std::abs(levelOf(image.color.at(x, y), 0) - truths[n]));
                    }
                std::printf("%s, %s: %.2f levels\n", c.name, std::string(nameOf(target)).c_str(), worst);
                EXPECT_LT(worst, 3) << c.name;
            }
        }
    }
}

// What a ray gathers depends neither on where it starts before the first of it, nor on the rays beside it.
TEST(Rings, KnownDepthsAndOtherPixelsChangeNothing) {
    const VolumeScene scene = ringBall(ringCases()[0].transfer);
    for (const EyeView& view : smallViews())
        for (const SimdTarget target : simdTargets()) {
            const VolumeRenderer renderer(scene, integrated(target));
            EyeImage image;
            image.resize(view.width, view.height, renderer.viewDependence());
            renderEye(renderer, view, image);
            EyeImage again = image, few = image;
            std::vector<PixelIndex> pixels;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    float& depth = again.viewDepth.at(x, y);
                    if (depth < kMissDepth) depth = (x + y) % 3 == 0 ? 0.0f : depth * 0.98f;
                    few.viewDepth.at(x, y) = 0;
                    if ((x * 7 + y) % 5 == 0)
                        pixels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
                }
            for (int tile = 0; tile < renderer.tileCount(view); ++tile)
                renderer.renderTileFromDepth(view, tile, again);
            renderer.renderPixels(view, {0, 0, view.width, view.height}, pixels, few);
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    ASSERT_EQ(again.color.at(x, y), image.color.at(x, y)) << x << "," << y;
                    ASSERT_EQ(again.viewDepth.at(x, y), image.viewDepth.at(x, y)) << x << "," << y;
                }
            for (const PixelIndex p : pixels)
                ASSERT_EQ(few.color.at(p.x, p.y), image.color.at(p.x, p.y)) << p.x << "," << p.y;
        }
}

TEST(Rings, ModulationCounts) {
    VolumeScene scene = ringBall(ringCases()[0].transfer);
    const auto modulation = std::make_shared<Volume<std::uint8_t>>(scene.field.frame);
    scene.look.modulation = modulation;
    const EyeView view = smallViews()[0];
    for (const SimdTarget target : simdTargets()) {
        const auto drawn = [&](const VolumeScene& shown) {
            const VolumeRenderer renderer(shown, integrated(target));
            EyeImage image;
            image.resize(view.width, view.height, renderer.viewDependence());
            renderEye(renderer, view, image);
            return image;
        };
        for (std::size_t n = 0; n < modulation->values.size(); ++n) modulation->values[n] = 0;
        const EyeImage none = drawn(scene);
        for (std::size_t n = 0; n < modulation->values.size(); ++n) modulation->values[n] = 255;
        const EyeImage full = drawn(scene), plain = drawn(ringBall(scene.look.transfer));
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                ASSERT_EQ(none.viewDepth.at(x, y), kMissDepth);
                ASSERT_LE(test::channelDifference(full.color.at(x, y), plain.color.at(x, y)), 1);
            }
    }
}

}  // namespace
}  // namespace stereonav
