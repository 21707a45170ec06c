// Baked light inside translucent volumes and at places whose texels are not known, against the plain caster:
// pictures of odd sizes, whole and pixel by pixel, on every instruction set. And numbers at the ends of what
// they may be, which must leave the kernels finite.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "engine/base/sanitizers.h"
#include "engine/camera/stereo_rig.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/baked_data.h"
#include "engine/volume/volume_renderer.h"
#include "tests/oracle/plain_composite.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

using namespace test;

// A ball, dense in its middle, with empty space around it.
VolumeScene ball(bool translucent) {
    VolumeScene scene;
    scene.field = greyVolume(slantedFrame({24, 22, 20}), [](const glm::dvec3& v) {
        return 100 * (7.5 - glm::length(v - glm::dvec3(11.3, 10.4, 9.6)));
    });
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = 0;
    if (translucent) {
        scene.look.transfer =
            TransferFunction({{0, {0.9f, 0.5f, 0.3f}, 0}, {400, {0.4f, 0.7f, 0.9f}, 0.6}}, 0.001, "test");
        setting.highest = 32767;
    }
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    scene.look.surface = {0.9f, 0.5f, 0.25f};
    return scene;
}

// known: of the texels, by chance; all of one weight.
std::shared_ptr<IlluminationVolume> someLight(const VolumeFrame& frame, double known, float weight,
                                              float brightest) {
    auto light = std::make_shared<IlluminationVolume>(frame);
    Random random(11);
    const glm::ivec3 size = frame.size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const glm::vec3 value(random.inBox(glm::dvec3(0.05), glm::dvec3(1.0)));
                if (random.between(0, 1) < known)
                    light->texels[light->layout.index(i, j, k)] = packTexel(brightest * value, weight);
            }
    return light;
}

std::shared_ptr<IlluminationVolume> coarseLight(const VolumeFrame& frame) {
    VolumeFrame coarse = frame;
    coarse.size = (frame.size + 3) / 4;
    coarse.spacing *= 4.0;
    return someLight(coarse, 1, 1, 1);
}

EyeView viewOf(const VolumeFrame& frame, const glm::ivec2& size) {
    Pose pose;
    pose.position = frame.worldFromVoxel({11, -24, 12});
    const glm::dvec3 forward = glm::normalize(frame.worldFromVoxel({11, 10, 9.5}) - pose.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
    pose.orientation = glm::quat_cast(glm::dmat3(right, glm::cross(right, forward), -forward));
    Lens lens;
    lens.width = size.x;
    lens.height = size.y;
    lens.verticalFov = 0.45;
    lens.nearDepth = 1e-4;
    return makeEyeView(pose, lens);
}

glm::dvec3 plainPixel(const VolumeScene& scene, const EyeView& view, int x, int y) {
    // From the eye on, from which kernels count their samples.
    const PlainRay ray{view.eye, view.rayDirection(x + 0.5, y + 0.5), 0.0};
    const glm::dvec3 background(scene.look.background);
    if (!scene.look.transfer.empty()) {
        const PlainComposite sum = compositePlain(scene.field, scene.look, ray, view.head, 0.5);
        return sum.color + (sum.left < 1.0 / 1024 ? 0.0 : sum.left) * background;
    }
    const PlainHit hit = castPlainVolume(scene.field, scene.cells.isovalue, ray);
    if (!hit.hit()) return background;
    return shadeBakedPlain(scene.look, view.eye + hit.t * ray.direction,
                           plainNormal(scene.field, hit.voxel()), view.head, view.eye,
                           glm::dvec3(scene.look.surface));
}

EyeImage emptyImage(const VolumeRenderer& renderer, const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height, renderer.viewDependence());
    return image;
}

// Expects the plain caster's picture, whole and as scattered pixels, on every instruction set; at most `most`
// of 1023 off.
void expectAsPlain(const VolumeScene& scene, const glm::ivec2& size, int most) {
    const EyeView view = viewOf(scene.field.frame, size);
    Plane<PackedColor> wanted(size.x, size.y);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            wanted.at(x, y) = packColor(glm::vec3(plainPixel(scene, view, x, y)));
    for (const SimdTarget target : simdTargets()) {
        SCOPED_TRACE(std::string(nameOf(target)));
        const VolumeRenderer renderer(scene, {target});
        EyeImage image = emptyImage(renderer, view), some = emptyImage(renderer, view);
        renderEye(renderer, view, image);
        std::vector<PixelIndex> pixels;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                pixels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
        renderer.renderPixels(view, {0, 0, size.x, size.y}, pixels, some);
        long long sum = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const int off = channelDifference(image.color.at(x, y), wanted.at(x, y));
                sum += off;
                ASSERT_LE(off, most) << x << "," << y;
                ASSERT_EQ(some.color.at(x, y), image.color.at(x, y)) << x << "," << y;
                if (!image.depthSpread.empty()) {
                    ASSERT_TRUE(std::isfinite(image.depthSpread.at(x, y)));
                }
            }
        EXPECT_LE(sum, size.x * size.y);
    }
}

// The first one's plain rays take nearly all of the time, and sanitizers have nothing to find in more of
// them.
const std::vector<glm::ivec2> kSizes{
    kAddressSanitizer || kThreadSanitizer ? glm::ivec2(25, 19) : glm::ivec2(49, 37),
    {1, 1},
    {17, 13},
    {63, 1}};

// The corners of a few packets see nothing of the ball: they must not darken what their neighbours see.
TEST(BakedTranslucent, isCompositedAsThePlainCasterDoes) {
    for (const BakedLook::Use use : {BakedLook::Use::Irradiance, BakedLook::Use::Openness})
        for (const double known : {1.0, 0.5, 0.0})
            for (const glm::ivec2& size : kSizes) {
                SCOPED_TRACE(testing::Message() << known << " " << size.x << "x" << size.y);
                VolumeScene scene = ball(true);
                scene.look.background = {0.02f, 0.05f, 0.1f};
                scene.look.baked.light = someLight(scene.field.frame, known, 1, 1);
                scene.look.baked.use = use;
                scene.look.baked.exposure = 1.4f;
                expectAsPlain(scene, size, 12);
            }
}

TEST(BakedTranslucent, takesLightFromBeyondWhereTexelsAreNotKnown) {
    for (const bool translucent : {true, false})
        for (const double known : {1.0, 0.5, 0.0})
            for (const float lampShare : {0.0f, 0.3f}) {
                SCOPED_TRACE(testing::Message() << translucent << " " << known << " " << lampShare);
                VolumeScene scene = ball(translucent);
                scene.look.baked.light = someLight(scene.field.frame, known, 1, 1);
                scene.look.baked.beyond = coarseLight(scene.field.frame);
                scene.look.baked.lampShare = lampShare;
                expectAsPlain(scene, {49, 37}, 12);
            }
}

// One model of light: all that is seen is twice as bright at twice the exposure.
TEST(BakedTranslucent, isLitByOneModelAlone) {
    VolumeScene scene = ball(true);
    scene.look.baked.light = someLight(scene.field.frame, 0.3, 1, 1);
    scene.look.baked.beyond = coarseLight(scene.field.frame);
    const EyeView view = viewOf(scene.field.frame, {49, 37});
    for (const SimdTarget target : simdTargets()) {
        Plane<PackedColor> pictures[2];
        for (int n = 0; n < 2; ++n) {
            scene.look.baked.exposure = n == 0 ? 0.3f : 0.6f;
            const VolumeRenderer renderer(scene, {target});
            EyeImage image = emptyImage(renderer, view);
            renderEye(renderer, view, image);
            pictures[n] = image.color;
        }
        int seen = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::vec3 once = unpackColor(pictures[0].at(x, y)),
                                twice = unpackColor(pictures[1].at(x, y));
                seen += once.x > 0.05f;
                // A step of 1023 of the root is 2 root(light) / 1023.
                for (int k = 0; k < 3; ++k)
                    ASSERT_NEAR(twice[k], 2 * once[k], 3 * (2 * std::sqrt(once[k]) + 1e-3f) / 1023)
                        << x << "," << y;
            }
        EXPECT_GT(seen, 400);
    }
}

// What is known counts however little it weighs; dim light with a high exposure is not lost in its weights.
TEST(BakedTranslucent, smallWeightsAndHighExposuresAreExact) {
    for (const bool translucent : {true, false}) {
        VolumeScene scene = ball(translucent);
        for (const float weight : {1.0f, 1.0f / 64, 1.0f / 1024}) {
            scene.look.baked.light = someLight(scene.field.frame, 1, weight, 0x1p-20f);
            scene.look.baked.exposure = 0x1p20f;
            expectAsPlain(scene, {33, 25}, translucent ? 12 : 2);
        }
    }
}

TEST(BakedTranslucent, extremeNumbersGiveAFinitePicture) {
    const float inf = std::numeric_limits<float>::infinity();
    for (const bool translucent : {true, false})
        for (const float exposure : {0.0f, -1.0f, 1e-30f, 1e6f, 1e30f, inf, std::nanf("")}) {
            SCOPED_TRACE(testing::Message() << translucent << " " << exposure);
            VolumeScene scene = ball(translucent);
            scene.look.baked.light = someLight(scene.field.frame, 0.7, 1, 1e30f);
            scene.look.baked.exposure = exposure;
            scene.look.falloff = 1e-20f;
            if (shownExposure(scene.look.baked) > 1) scene.look.baked.lampShare = 1;
            scene.look.baked.beyond = coarseLight(scene.field.frame);
            expectAsPlain(scene, {33, 25}, 12);
        }
}

}  // namespace
}  // namespace stereonav
