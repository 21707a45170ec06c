// Openness as ambient light, k O C (Ruiz et al. 2010, eq. 5): packets against the plain form, one pixel at a
// time, of surfaces and of translucent volumes, with and without the lamp.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "engine/base/error.h"
#include "engine/camera/stereo_rig.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/volume_renderer.h"
#include "tests/oracle/plain_composite.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

using namespace test;

constexpr int kWidth = 61, kHeight = 47;
const glm::vec3 kSurface{0.9f, 0.5f, 0.25f};

std::shared_ptr<Volume<std::uint8_t>> randomBytes(const VolumeFrame& frame, unsigned seed) {
    auto bytes = std::make_shared<Volume<std::uint8_t>>(frame);
    Random random(seed);
    for (std::size_t n = 0; n < bytes->values.size(); ++n)
        bytes->values[n] = static_cast<std::uint8_t>(random.between(0, 255.99));
    return bytes;
}

// A ball of radius 7 voxels that is dense at its middle; opaque at 0, or showing all values above -1.
VolumeScene ambientBall(bool translucent) {
    const VolumeFrame frame = slantedFrame({26, 22, 24}, {0.8e-3, 0.7e-3, 0.9e-3});
    VolumeScene scene;
    scene.field = greyVolume(
        frame, [](const glm::dvec3& v) { return 100 * (7 - glm::length(v - glm::dvec3(12, 11, 12))); });
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = 0;
    if (translucent) {
        scene.look.transfer =
            TransferFunction({{-1, glm::vec3(0.2f, 0.9f, 0.4f), 0.0}, {300, kSurface, 0.5}}, 0.001, "test");
        setting.lowest = -1;
        setting.highest = 32767;
    }
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    scene.look.surface = kSurface;
    scene.look.falloff = 0;
    return scene;
}

EyeView ambientViewOf(const VolumeFrame& frame, const glm::dvec3& voxel) {
    Pose pose;
    pose.position = frame.worldFromVoxel(voxel);
    const glm::dvec3 forward = glm::normalize(frame.worldFromVoxel({12, 11, 12}) - pose.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
    pose.orientation = glm::quat_cast(glm::dmat3(right, glm::cross(right, forward), -forward));
    Lens lens;
    lens.width = kWidth;
    lens.height = kHeight;
    lens.verticalFov = 0.6;
    lens.nearDepth = 1e-4;
    return makeEyeView(pose, lens);
}

EyeImage castAmbient(const VolumeRenderer& renderer, const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, image);
    return image;
}

// body(x, y, depth, voxel) for all pixels that show something; gives their number.
template <typename Body>
int forHits(const EyeImage& image, const EyeView& view, const VolumeFrame& frame, const Body& body) {
    int hits = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double depth = image.viewDepth.at(x, y);
            if (!(depth < kMissDepth)) continue;
            ++hits;
            body(x, y, frame.voxelFromWorld(view.eye + depth * view.rayDirection(x + 0.5, y + 0.5)));
        }
    return hits;
}

TEST(AmbientLook, AnEvenOpennessIsTheFormulaItself) {
    VolumeScene scene = ambientBall(false);
    const auto open = std::make_shared<Volume<std::uint8_t>>(scene.field.frame);
    std::fill_n(open->values.data(), open->values.size(), std::uint8_t{102});  // 0.4
    scene.look.occlusion.openness = open;
    scene.look.occlusion.strength = 1.5f;
    const EyeView view = ambientViewOf(scene.field.frame, {12, -18, 14});
    for (const SimdTarget target : simdTargets()) {
        const EyeImage image = castAmbient(VolumeRenderer(scene, {target}), view);
        const int hits = forHits(image, view, scene.field.frame, [&](int x, int y, const glm::dvec3&) {
            ASSERT_LE(channelDifference(image.color.at(x, y), packColor(0.6f * kSurface)), 1);
        });
        EXPECT_GT(hits, 300);
    }
}

TEST(AmbientLook, SurfacesAreAsThePlainFormHasThem) {
    VolumeScene scene = ambientBall(false);
    const VolumeFrame& frame = scene.field.frame;
    scene.look.occlusion.openness = randomBytes(frame, 3);
    scene.look.occlusion.strength = 0.8f;
    for (const float share : {0.0f, 0.3f}) {
        scene.look.occlusion.lampShare = share;
        for (const glm::dvec3 from : {glm::dvec3(12, -18, 14), glm::dvec3(-9, 3, 30)}) {
            const EyeView view = ambientViewOf(frame, from);
            for (const SimdTarget target : simdTargets()) {
                const VolumeRenderer renderer(scene, {target});
                EXPECT_EQ(renderer.viewDependence(), ViewDependence::Normal);
                EyeImage image = castAmbient(renderer, view);
                const int hits = forHits(image, view, frame, [&](int x, int y, const glm::dvec3& voxel) {
                    const glm::dvec3 wanted =
                        lightPlain(scene.look, frame, voxel, plainNormal(scene.field, voxel), view.head,
                                   view.eye, glm::dvec3(kSurface));
                    ASSERT_LE(channelDifference(image.color.at(x, y), packColor(glm::vec3(wanted))),
                              share > 0 ? 4 : 2)
                        << x << " " << y;
                });
                EXPECT_GT(hits, 300);
                // Rows shaded again look it up once more.
                const Plane<PackedColor> first = image.color;
                for (int y = 0; y < kHeight; ++y) {
                    std::fill_n(image.color.row(y), kWidth, PackedColor{0});
                    renderer.shadeAgain(view, y, 0, kWidth, image);
                    for (int x = 0; x < kWidth; ++x)
                        ASSERT_LE(channelDifference(image.color.at(x, y), first.at(x, y)), 4);
                }
            }
        }
    }
}

struct PlainPicture {
    Plane<PackedColor> colors{kWidth, kHeight};
    int seen = 0;  // pixels that lose more than a tenth of the background
};

PlainPicture plainPicture(const VolumeScene& scene, const EyeView& view) {
    PlainPicture picture;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const PlainComposite truth =
                compositePlain(scene.field, scene.look, {view.eye, view.rayDirection(x + 0.5, y + 0.5), 0.0},
                               view.head, 0.5);
            picture.colors.at(x, y) =
                packColor(glm::vec3(truth.color) + static_cast<float>(truth.left) * scene.look.background);
            picture.seen += truth.left < 0.9;
        }
    return picture;
}

void expectNear(const EyeImage& image, const PlainPicture& truth) {
    long long sum = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const int off = channelDifference(image.color.at(x, y), truth.colors.at(x, y));
            ASSERT_LE(off, 12) << x << " " << y;
            sum += off;
        }
    EXPECT_LT(sum, kWidth * kHeight);
}

TEST(AmbientLook, TranslucentVolumesAreLitWhereverTheyAreSeen) {
    VolumeScene scene = ambientBall(true);
    const VolumeFrame& frame = scene.field.frame;
    scene.look.specular = 0.3f;
    for (const float share : {0.0f, 0.4f})
        for (const bool modulated : {false, true}) {
            scene.look.occlusion = {randomBytes(frame, 5), 0.9f, share};
            scene.look.modulation = modulated ? randomBytes(frame, 6) : nullptr;
            const EyeView view = ambientViewOf(frame, {12, -18, 14});
            const PlainPicture truth = plainPicture(scene, view);
            EXPECT_GT(truth.seen, 300);
            for (const SimdTarget target : simdTargets())
                expectNear(castAmbient(VolumeRenderer(scene, {target}), view), truth);
        }
}

TEST(AmbientLook, IsOfTheSameVolumeAndGivesWayToBakedLight) {
    VolumeScene scene = ambientBall(false);
    const VolumeFrame& frame = scene.field.frame;
    const EyeView view = ambientViewOf(frame, {12, -18, 14});
    scene.look.baked.light = std::make_shared<IlluminationVolume>(texelFrame(frame, 1));
    const EyeImage baked = castAmbient(VolumeRenderer(scene), view);
    scene.look.occlusion.openness = randomBytes(frame, 7);
    const EyeImage both = castAmbient(VolumeRenderer(scene), view);
    forHits(both, view, frame,
            [&](int x, int y, const glm::dvec3&) { ASSERT_EQ(both.color.at(x, y), baked.color.at(x, y)); });
    scene.look.baked.light = nullptr;
    EXPECT_NO_THROW(VolumeRenderer{scene});
    VolumeFrame other = frame;
    other.size.z -= 1;
    scene.look.occlusion.openness = randomBytes(other, 7);
    EXPECT_THROW(VolumeRenderer{scene}, Error);
}

// A grid of 4 x 3 x 5 cells around the ball, each of which sees something else.
StudioLook randomStudio(unsigned seed) {
    auto grid = std::make_shared<SkyGrid>();
    grid->size = {4, 3, 5};
    grid->first = {1, -3, 0};
    grid->cellVoxels = {7, 9, 6};
    grid->words = LazyArray<std::uint32_t>(2 * grid->count());
    Random random(seed);
    for (std::size_t n = 0; n < grid->count(); ++n)
        packSky(0.25 * random.direction(), random.between(0.2, 0.8), random.between(0, 1),
                grid->words.data() + 2 * n);
    StudioLook look;
    look.seen = grid;
    look.sky = {0.4f, 0.5f, 0.6f};
    look.ground = {0.3f, 0.2f, 0.1f};
    look.key = {0.6f, 0.5f, 0.4f};
    look.up = random.direction();
    look.keyFrom = random.direction();
    look.lamp = 0.4f;
    look.lampDeep = 0.3f;
    return look;
}

TEST(StudioLook, SurfacesAreAsThePlainFormHasThem) {
    VolumeScene scene = ambientBall(false);
    const VolumeFrame& frame = scene.field.frame;
    for (const unsigned seed : {1u, 2u, 3u}) {
        scene.look.studio = randomStudio(seed);
        const EyeView view = ambientViewOf(frame, {12, -18, 14});
        for (const SimdTarget target : simdTargets()) {
            const VolumeRenderer renderer(scene, {target});
            EXPECT_EQ(renderer.viewDependence(), ViewDependence::Normal);
            EyeImage image = castAmbient(renderer, view);
            const int hits = forHits(image, view, frame, [&](int x, int y, const glm::dvec3& voxel) {
                const glm::dvec3 wanted =
                    lightPlain(scene.look, frame, voxel, plainNormal(scene.field, voxel), view.head, view.eye,
                               glm::dvec3(kSurface));
                ASSERT_LE(channelDifference(image.color.at(x, y), packColor(glm::vec3(wanted))), 5)
                    << x << " " << y;
            });
            EXPECT_GT(hits, 300);
            const Plane<PackedColor> first = image.color;
            for (int y = 0; y < kHeight; ++y) {
                std::fill_n(image.color.row(y), kWidth, PackedColor{0});
                renderer.shadeAgain(view, y, 0, kWidth, image);
                for (int x = 0; x < kWidth; ++x)
                    ASSERT_LE(channelDifference(image.color.at(x, y), first.at(x, y)), 5);
            }
        }
    }
}

TEST(StudioLook, TranslucentVolumesAreLitWhereverTheyAreSeen) {
    VolumeScene scene = ambientBall(true);
    scene.look.specular = 0.3f;
    scene.look.studio = randomStudio(4);
    const EyeView view = ambientViewOf(scene.field.frame, {12, -18, 14});
    const PlainPicture truth = plainPicture(scene, view);
    for (const SimdTarget target : simdTargets())
        expectNear(castAmbient(VolumeRenderer(scene, {target}), view), truth);
}

TEST(StudioLook, GivesWayToOpennessAndBakedLight) {
    VolumeScene scene = ambientBall(false);
    const VolumeFrame& frame = scene.field.frame;
    const EyeView view = ambientViewOf(frame, {12, -18, 14});
    scene.look.occlusion.openness = randomBytes(frame, 3);
    const EyeImage wanted = castAmbient(VolumeRenderer(scene), view);
    scene.look.studio = randomStudio(5);
    const EyeImage image = castAmbient(VolumeRenderer(scene), view);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) ASSERT_EQ(image.color.at(x, y), wanted.color.at(x, y));
    EXPECT_FALSE(scene.look.showsStudio());
    scene.look.occlusion = {};
    EXPECT_TRUE(scene.look.showsStudio());
    scene.look.baked.light = std::make_shared<IlluminationVolume>(texelFrame(frame, 1));
    EXPECT_FALSE(scene.look.showsStudio());
}

}  // namespace
}  // namespace stereonav
