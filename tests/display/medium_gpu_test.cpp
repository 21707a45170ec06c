// The sweep in GLSL against the reference model (plain_sweep.h), on small pictures: every model, light from
// before, behind and beside, lamps, two eyes, noise, one target and several. Runs without a display.
#include <functional>
#include <random>

#include "engine/base/error.h"
#include "tests/display/medium_gpu_subject.h"

namespace stereonav::gpu_test {
namespace {

TEST_F(MediumGpuTest, EveryModelForwardAndBackward) {
    Subject subject(Medium(blobs(), transfer()));
    for (const MediumModel model :
         {MediumModel::Emission, MediumModel::Surface, MediumModel::Direct, MediumModel::Indirect})
        for (const glm::dvec3& direction : {kWithView, kAgainstView, kBeside}) {
            SCOPED_TRACE(nameOf(model));
            expectAsByTheBook(subject, lookOf(model, direction), {viewFrom(kEye, kMiddle)}, smallSetting());
        }
}

TEST_F(MediumGpuTest, SurfaceWeightHighlightGlowAndColouredPhase) {
    Subject subject(Medium(blobs(), transfer(0.8, 0.3f)));
    for (const MediumModel model : {MediumModel::Emission, MediumModel::Surface, MediumModel::Indirect})
        for (const glm::dvec3& direction : {kWithView, kAgainstView}) {
            MediumLook look = lookOf(model, direction);
            look.phase = PhaseFunction::henyeyGreenstein({0.7f, -0.3f, 0.2f});
            look.indirectShare = 0.6f;
            look.specular = 1.5f;
            expectAsByTheBook(subject, look, {viewFrom(kEye, kMiddle)}, smallSetting());
        }
}

// Some texels are not known, and not all count alike; or all are.
std::shared_ptr<IlluminationVolume> bakedLight(bool all = false) {
    VolumeFrame frame = blobs()->frame;
    frame.size = {9, 8, 10};
    frame.spacing *= 1.9;
    auto light = std::make_shared<IlluminationVolume>(frame);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> number(0, 1);
    for (int k = 0; k < 10; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 9; ++i) {
                const glm::vec3 value(number(random), number(random), 2 * number(random));
                const float weight = all ? 1.0f : k > 7 ? 0.0f : 0.5f + 0.5f * value.x;
                if (all || number(random) < 0.7f || k > 6)
                    light->texels[light->layout.index(i, j, k)] =
                        packTexel(weight > 0 ? value : glm::vec3(0), weight);
            }
    return light;
}

TEST_F(MediumGpuTest, BakedLightOnSurfaces) {
    Subject subject(Medium(blobs(), transfer(0.9)));
    MediumLook look = lookOf(MediumModel::Indirect, kWithView);
    look.baked.light = bakedLight();
    look.baked.exposure = 1.3f;
    look.baked.lampShare = 0.4f;
    // The texels are half floats here, times their weights.
    expectAsByTheBook(subject, look, {viewFrom(kEye, kMiddle)}, smallSetting());
    look.baked.use = BakedLook::Use::Openness;
    expectAsByTheBook(subject, look, {viewFrom(kEye, kMiddle)}, smallSetting());
    look.baked.beyond = bakedLight(true);
    expectAsByTheBook(subject, look, {viewFrom(kEye, kMiddle)}, smallSetting());
    std::vector<MediumPicture> with(1), without(1);
    subject.gpu.render(look, smallSetting(), {{viewFrom(kEye, kMiddle)}}, kEye, 0, with);
    look.baked.light = nullptr;
    subject.gpu.render(look, smallSetting(), {{viewFrom(kEye, kMiddle)}}, kEye, 0, without);
    EXPECT_GT(differenceOf(with[0], without[0]).worst, 0.05);
}

TEST_F(MediumGpuTest, LampsBeforeBesideAndInTheMedium) {
    Subject subject(Medium(blobs(), transfer()));
    for (const glm::dvec3& place :
         {glm::dvec3(-1, -2, 1), glm::dvec3(1.5, 1.5, 0.3), glm::dvec3(0.1, -0.1, 0.2)})
        for (const double cone : {2.0, 0.6}) {
            MediumLook look = lookOf(MediumModel::Indirect, -place);
            look.light.kind = MediumLight::Kind::Lamp;
            look.light.position = kMiddle + place;
            look.light.coneAngle = cone;
            look.light.falloff = 1.5;
            expectAsByTheBook(subject, look, {viewFrom(kEye, kMiddle)}, smallSetting());
        }
}

// Taps from far below a texel to many texels away; of a lamp both in one slab.
TEST_F(MediumGpuTest, NarrowAndWideBlurs) {
    Subject subject(Medium(blobs(), transfer()));
    MediumLook lamp = lookOf(MediumModel::Indirect, {0.3, 0.8, -0.4});
    lamp.light.kind = MediumLight::Kind::Lamp;
    lamp.light.position = kMiddle - 1.4 * lamp.light.direction;
    for (const MediumLook& look :
         {lookOf(MediumModel::Indirect, kWithView), lookOf(MediumModel::Indirect, kAgainstView), lamp})
        for (const double cone : {0.0, 0.5, 1.0, 1.5, 2.5}) {
            SweepSetting setting = smallSetting();
            setting.coneAngle = cone;
            setting.blurLength = 0.1;
            setting.lightSize = 32;
            SCOPED_TRACE(cone);
            expectAsByTheBook(subject, look, {viewFrom(kEye, kMiddle)}, setting);
        }
    std::vector<MediumPicture> sharp(1), soft(1);
    SweepSetting setting = smallSetting();
    setting.coneAngle = 0;
    subject.gpu.render(lamp, setting, {{viewFrom(kEye, kMiddle)}}, kEye, 0, sharp);
    setting.coneAngle = 2.5;
    subject.gpu.render(lamp, setting, {{viewFrom(kEye, kMiddle)}}, kEye, 0, soft);
    EXPECT_GT(differenceOf(sharp[0], soft[0]).worst, 0.02) << "the blur does nothing";
}

// Light across the view, where slabs lean most and taps count by V11; on both sides of the right angle.
TEST_F(MediumGpuTest, SlabsThatLean) {
    Subject subject(Medium(blobs(), transfer()));
    const EyeView view = viewFrom(kEye, kMiddle);
    for (const auto& [degrees, lamp] :
         {std::pair(80.0, false), std::pair(65.0, true), std::pair(100.0, false)}) {
        const double angle = degrees * std::acos(-1.0) / 180;
        MediumLook look = lookOf(MediumModel::Indirect,
                                 std::cos(angle) * view.forward + std::sin(angle) * (view.right - view.up));
        if (lamp) look.light.kind = MediumLight::Kind::Lamp;
        look.light.position = kMiddle - 1.6 * look.light.direction;
        SweepSetting setting = smallSetting();
        for (const double cone : {0.5, 1.5}) {
            setting.coneAngle = cone;
            setting.blurLength = 0.1;
            setting.lightSize = 28;
            SCOPED_TRACE(cone);
            EXPECT_GT(makeSweepGeometry(subject.medium, look, setting, {{view}}, view.head).leaning, 0.2);
            expectAsByTheBook(subject, look, {view}, setting);
        }
    }
}

TEST_F(MediumGpuTest, TheHeadsLampAndAnEyeInside) {
    Subject subject(Medium(blobs(), transfer(0.5)));
    MediumLook look = lookOf(MediumModel::Indirect, {0, 0, -1});
    look.light.kind = MediumLight::Kind::Lamp;
    look.light.atHead = true;
    expectAsByTheBook(subject, look, {viewFrom(kEye, kMiddle)}, smallSetting());
    const glm::dvec3 inside = kMiddle + glm::dvec3(0.3, -0.3, -0.2);
    expectAsByTheBook(subject, look, {viewFrom(inside, kMiddle)}, smallSetting());
    for (const glm::dvec3& direction : {kWithView, kAgainstView})
        expectAsByTheBook(subject, lookOf(MediumModel::Indirect, direction), {viewFrom(inside, kMiddle)},
                          smallSetting());
}

// Two regions over value and gradient magnitude.
MediumTransfer steepTransfer() {
    MediumRegion body, edge;
    std::copy_n(std::initializer_list<double>{200, 400, 2000, 2001}.begin(), 4, body.value);
    std::copy_n(std::initializer_list<double>{0, 0, 800, 2000}.begin(), 4, body.gradient);
    body.material = {{0.4f, 0.7f, 0.9f}, 0.4, {0.5f, 0.7f, 0.9f}, 0.1, {}};
    std::copy_n(std::initializer_list<double>{100, 300, 800, 1200}.begin(), 4, edge.value);
    std::copy_n(std::initializer_list<double>{900, 1800, 1e5, 2e5}.begin(), 4, edge.gradient);
    edge.material = {{0.9f, 0.5f, 0.2f}, 0.8, {0.9f, 0.6f, 0.5f}, 0.9, {}};
    return {{body, edge}, 0.2, "test"};
}

TEST_F(MediumGpuTest, TheGradientChoosesToo) {
    Subject subject(Medium(blobs(), steepTransfer()));
    ASSERT_TRUE(subject.medium.table().usesGradient());
    for (const glm::dvec3& direction : {kWithView, kAgainstView})
        expectAsByTheBook(subject, lookOf(MediumModel::Indirect, direction), {viewFrom(kEye, kMiddle)},
                          smallSetting());
}

TEST_F(MediumGpuTest, StoredValuesAreScaledAndShifted) {
    Subject subject(Medium(blobs(0.02, 500), transfer()));
    expectAsByTheBook(subject, lookOf(MediumModel::Direct, kWithView), {viewFrom(kEye, kMiddle)},
                      smallSetting());
}

// Values that 16 bits hold exactly at both ends: formats that are normalised lose -32768.
TEST_F(MediumGpuTest, TheLeastAndTheLargestValueAreTold) {
    VolumeFrame frame;
    frame.size = {2, 2, 2};
    frame.origin = glm::dvec3(-0.5);
    auto field = std::make_shared<GreyVolume>(frame);
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) field->at(i, j, k) = k == 0 ? -32768 : 32767;
    Subject subject(Medium(field, transfer()));
    expectAsByTheBook(subject, lookOf(MediumModel::Emission, kWithView),
                      {viewFrom({0.1, -2, 0.2}, glm::dvec3(0.0))}, smallSetting());
}

TEST_F(MediumGpuTest, NoiseMovesPlacesAndChangesProperties) {
    Subject subject(Medium(blobs(), transfer(0.4), twoScales()));
    const MediumLook look = lookOf(MediumModel::Indirect, kWithView);
    for (const double time : {0.0, 1.7, 86400.25})
        expectAsByTheBook(subject, look, {viewFrom(kEye, kMiddle)}, smallSetting(), time);
}

bool equal(const MediumPicture& a, const MediumPicture& b, double most = 0) {
    if (a.light.width() != b.light.width() || a.light.height() != b.light.height()) return false;
    const Difference d = differenceOf(a, b);
    return d.worst <= most && d.depths == 0;
}

TEST_F(MediumGpuTest, TwoEyesInOneSweepIntoOneTargetOrSeveral) {
    Subject subject(Medium(blobs(), transfer()));
    EyeView left = viewFrom(kEye, kMiddle), right = left;
    left.eye -= 0.1 * left.right;
    right.eye += 0.1 * right.right;
    right.height = 18;  // they need not be alike
    const std::vector<EyeView> eyes{left, right};
    for (const glm::dvec3& direction : {kWithView, kAgainstView}) {
        const MediumLook look = lookOf(MediumModel::Indirect, direction);
        expectAsByTheBook(subject, look, eyes, smallSetting(true));
        MediumGpu& gpu = subject.gpu;
        std::vector<MediumPicture> one(2), several(2);
        gpu.render(look, smallSetting(true), eyes, left.head, 0, one);
        gpu.render(look, smallSetting(false), eyes, left.head, 0, several);
        // Texture coordinates of the light's buffer are rounded otherwise in a larger texture.
        for (int eye = 0; eye < 2; ++eye) EXPECT_TRUE(equal(one[eye], several[eye], 1e-5)) << eye;
    }
}

TEST_F(MediumGpuTest, TheSameAgainAfterOtherFrames) {
    Subject subject(Medium(blobs(), transfer(0.3)));
    const std::vector<EyeView> eyes{viewFrom(kEye, kMiddle)};
    const MediumLook look = lookOf(MediumModel::Indirect, kWithView);
    MediumGpu& gpu = subject.gpu;
    std::vector<MediumPicture> first(1), other(1), again(1);
    gpu.render(look, smallSetting(), eyes, eyes[0].head, 0, first);
    MediumLook lamp = lookOf(MediumModel::Direct, kAgainstView);
    lamp.light.kind = MediumLight::Kind::Lamp;
    lamp.light.position = kMiddle + glm::dvec3(0, 2, 1);
    lamp.phase = PhaseFunction::henyeyGreenstein(glm::vec3(0.5f));
    gpu.render(lamp, smallSetting(false), {{viewFrom(kEye, kMiddle, 31, 9)}}, eyes[0].head, 0, other);
    EXPECT_FALSE(equal(first[0], other[0]));
    gpu.render(look, smallSetting(), eyes, eyes[0].head, 0, again);
    EXPECT_TRUE(equal(first[0], again[0]));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    for (const GLenum what : {GL_BLEND, GL_SCISSOR_TEST, GL_DEPTH_TEST}) EXPECT_FALSE(glIsEnabled(what));
    GLint bound = -1;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(bound, 0);
}

TEST_F(MediumGpuTest, EmptySpaceShowsWhatLiesBehind) {
    const MediumTransfer none(std::vector<MediumPoint>{{0, {}}, {1000, {}}}, 0.2, "test");
    for (const Medium& medium : {Medium(), Medium(blobs(), none)}) {
        std::vector<MediumPicture> got(1);
        const std::vector<EyeView> eyes{viewFrom(kEye, kMiddle)};
        MediumGpu(medium).render(lookOf(MediumModel::Indirect, kWithView), smallSetting(), eyes, kEye, 0,
                                 got);
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 24; ++x) {
                ASSERT_EQ(got[0].light.at(x, y), glm::vec4(0, 0, 0, 1));
                ASSERT_EQ(got[0].viewDepth.at(x, y), kMissDepth);
            }
    }
}

// A cube of one value, 2 m wide, `depth` deep optically along y; seen along y by nearly parallel rays.
Medium cubeOf(double depth) {
    VolumeFrame frame;
    frame.size = {2, 2, 2};
    frame.spacing = glm::dvec3(2.0);
    frame.origin = glm::dvec3(-1.0);
    auto field = std::make_shared<GreyVolume>(frame);
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) field->at(i, j, k) = 500;
    // Opacity of a layer of the reference length 2 m / depth: 1 - 1 / e.
    MediumMaterial material{glm::vec3(1.0f), 1 - std::exp(-1.0), glm::vec3(1.0f), 0, {}};
    return Medium(
        field, MediumTransfer(std::vector<MediumPoint>{{0, material}, {1000, material}}, 2 / depth, "test"));
}

// What a cube sends of light scattered once on its way along the view, for any number of slabs.
TEST_F(MediumGpuTest, ClosedFormsOfACubeFromThinToDense) {
    EyeView view = viewFrom({0, -1e4, 0}, glm::dvec3(0.0), 3, 3);
    view.xMin = view.yMin = -1e-5;
    view.xMax = view.yMax = 1e-5;
    for (const double depth : {1e-6, 0.1, 5.0, 1e6}) {
        Subject subject(cubeOf(depth));
        for (const int slices : {1, 7, 300})
            for (const bool forward : {true, false}) {
                MediumLook look = lookOf(MediumModel::Direct, {0, forward ? 1 : -1, 0});
                look.light.radiance = glm::vec3(1.0f);
                SweepSetting setting = smallSetting();
                setting.slices = slices;
                std::vector<MediumPicture> got(1);
                subject.gpu.render(look, setting, {{view}}, view.eye, 0, got);
                const double expected = forward ? -std::expm1(-2 * depth) / 2 : depth * std::exp(-depth);
                const glm::vec4 seen = got[0].light.at(1, 1);
                SCOPED_TRACE(testing::Message() << depth << ' ' << slices << ' ' << forward);
                EXPECT_NEAR(seen.g, expected, 1e-4 * expected + 1e-9);
                EXPECT_NEAR(seen.a, std::exp(-depth), depth > 6 ? 1.0 / 1024 : 2e-5);  // 300 roundings
                EXPECT_LE(seen.r, 1.0f);
            }
    }
}

TEST_F(MediumGpuTest, MoreEyesThanItHoldsAreRefused) {
    Subject subject(Medium(blobs(), transfer()));
    const std::vector<EyeView> eyes(5, viewFrom(kEye, kMiddle));
    std::vector<MediumPicture> pictures(5);
    EXPECT_THROW(subject.gpu.render(MediumLook(), smallSetting(), eyes, kEye, 0, pictures), Error);
    pictures.resize(1);
    EXPECT_THROW(subject.gpu.render(MediumLook(), smallSetting(), {eyes.data(), 2}, kEye, 0, pictures),
                 Error);
}

}  // namespace
}  // namespace stereonav::gpu_test
