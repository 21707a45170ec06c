// The sweep's reference model against closed forms: it computes what docs/volume_light.md says.
#include "tests/oracle/plain_sweep.h"

#include <random>

#include "sweep_scenes.h"

namespace stereonav {
namespace {

using test::makeField;
using test::slabGeometry;
using test::slabOf;
using test::sun;
using test::Uniform;
using test::viewFrom;

// Light along z at a cosine, in the plane across from the eye's.
MediumLight sunAt(double cosine, float radiance = 1) {
    return sun({std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, cosine}, radiance);
}

glm::dvec4 middleOf(const MediumPicture& picture) {
    return glm::dvec4(picture.light.at(picture.light.width() / 2, picture.light.height() / 2));
}

glm::dvec4 sweepSlab(const Medium& medium, const MediumLook& look, double eyeCosine, bool forward, int slices,
                     double thick) {
    SweepSetting setting;
    setting.slices = slices;
    setting.coneAngle = 0;
    const SweepGeometry g = slabGeometry(medium, look, setting, eyeCosine, forward, thick);
    return middleOf(plainSweep(medium, look, setting, g)[0]);
}

double mean(double z) {
    return z == 0 ? 1 : -std::expm1(-z) / z;
}
// Returns the share of light that a whole slab of optical depths x, y sends back, or on: by hand from the
// integral.
double shareOf(double x, double y, bool forward) {
    if (forward) return x * mean(x + y);
    return y > x ? x * std::exp(-x) * mean(y - x) : x * std::exp(-y) * mean(x - y);
}

TEST(PlainSweep, aHomogeneousSlabIsExactForAnyNumberOfSlices) {
    const double thick = 0.3;
    for (const bool forward : {true, false})
        for (const double tau : {0.01, 1.0, 10.0})
            for (const double lightCosine : {1.0, 0.8, 0.3})
                for (const int slices : {1, 2, 7, 64}) {
                    const Medium medium = slabOf({{tau}}, thick);
                    MediumLook look;
                    look.model = MediumModel::Direct;
                    look.light = sunAt(lightCosine);
                    const double x = tau * thick / 0.7, y = tau * thick / lightCosine;
                    const glm::dvec4 seen = sweepSlab(medium, look, 0.7, forward, slices, thick);
                    EXPECT_NEAR(seen.x, shareOf(x, y, forward), 2e-6) << tau << " " << slices;
                    EXPECT_NEAR(seen.w, std::exp(-x), 2e-6);
                }
}

TEST(PlainSweep, indirectLightOfASlabFollowsItsOwnExtinction) {
    const double thick = 0.3;
    const glm::dvec3 indirect(0.2, 1.5, 6.0);
    const Medium medium = slabOf({{2.0, indirect, glm::vec3(0.5f, 1.0f, 0.25f)}}, thick);
    MediumLook look;
    look.light = sunAt(0.8, 2.0f);
    look.indirectShare = 0.5f;
    for (const bool forward : {true, false})
        for (const int slices : {1, 5, 50}) {
            const glm::dvec4 seen = sweepSlab(medium, look, 0.6, forward, slices, thick);
            const double x = 2 * thick / 0.6, d = shareOf(x, 2 * thick / 0.8, forward);
            const glm::dvec3 color(0.5, 1, 0.25);
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(seen[k],
                            2 * color[k] * (d + 0.5 * shareOf(x, indirect[k] * thick / 0.8, forward)), 1e-5)
                    << k;
        }
}

TEST(PlainSweep, twoLayersAreExactWhereSlicesMeetTheirBorder) {
    const double thick = 1.0;
    const Medium medium = slabOf({{0.5}, {4.0}}, thick);
    MediumLook look;
    look.model = MediumModel::Direct;
    look.light = sunAt(0.9);
    const double x1 = 0.25 / 0.7, y1 = 0.25 / 0.9, x2 = 2 / 0.7, y2 = 2 / 0.9;
    const double forward = shareOf(x1, y1, true) + std::exp(-x1 - y1) * shareOf(x2, y2, true);
    const double backward = std::exp(-y1) * shareOf(x2, y2, false) + std::exp(-x2) * shareOf(x1, y1, false);
    for (const int slices : {2, 4, 32, 256}) {
        EXPECT_NEAR(sweepSlab(medium, look, 0.7, true, slices, thick).x, forward, 2e-6) << slices;
        EXPECT_NEAR(sweepSlab(medium, look, 0.7, false, slices, thick).x, backward, 2e-6) << slices;
    }
}

TEST(PlainSweep, modelsDifferAsTheirNamesSay) {
    const double thick = 1.0, x = 2.0 / 0.7;
    Uniform u{2.0};
    u.color = {0.5f, 0.25f, 1.0f};
    u.glow = {3.0f, 0.0f, 0.0f};
    const Medium medium = slabOf({u}, thick);
    MediumLook look;
    look.light = sunAt(0.9, 4.0f);
    look.model = MediumModel::Emission;
    const double opacity = -std::expm1(-x);
    EXPECT_NEAR(sweepSlab(medium, look, 0.7, true, 8, thick).x, opacity * 3.5, 1e-5);
    EXPECT_NEAR(sweepSlab(medium, look, 0.7, true, 8, thick).y, opacity * 0.25, 1e-5);
    look.model = MediumModel::Surface;  // no surface weight: light alone
    EXPECT_NEAR(sweepSlab(medium, look, 0.7, true, 8, thick).x, opacity * (4 * 0.5 + 3), 1e-5);
    look.model = MediumModel::Direct;
    EXPECT_NEAR(sweepSlab(medium, look, 0.7, true, 8, thick).z, 4 * shareOf(x, 2 / 0.9, true), 1e-5);
}

TEST(PlainSweep, weighsDirectLightByThePhaseFunction) {
    const double thick = 1.0;
    const Medium medium = slabOf({{1.0}}, thick);
    MediumLook look;
    look.model = MediumModel::Direct;
    look.light = sunAt(0.8);
    const double plain = sweepSlab(medium, look, 0.6, true, 4, thick).x;
    look.phase = PhaseFunction::henyeyGreenstein({0.5f, 0.0f, -0.5f});
    const glm::dvec4 seen = sweepSlab(medium, look, 0.6, true, 4, thick);
    // The eye looks along (0, 0.8, 0.6), light comes along (0.6, 0, 0.8): what reaches the eye goes back.
    const double cosine = -0.48;
    const auto hg = [&](double g) { return (1 - g * g) / std::pow(1 + g * g - 2 * g * cosine, 1.5); };
    EXPECT_NEAR(seen.x, plain * hg(0.5), 1e-4);
    EXPECT_NEAR(seen.y, plain, 1e-6);
    EXPECT_NEAR(seen.z, plain * hg(-0.5), 1e-4);
}

// A lamp far away with no falloff is a parallel light; with falloff it is weaker by the formula; beyond its
// cone there is none.
TEST(PlainSweep, lampsFallOffAndEndAtTheirCone) {
    const double thick = 0.1;
    const Medium medium = slabOf({{1.0}}, thick);
    MediumLook look;
    look.model = MediumModel::Direct;
    look.light = sunAt(1);
    const double parallel = sweepSlab(medium, look, 0.7, true, 4, thick).x;
    look.light.kind = MediumLight::Kind::Lamp;
    look.light.position = {0, 0, -100};
    look.light.coneAngle = 0.5;
    EXPECT_NEAR(sweepSlab(medium, look, 0.7, true, 4, thick).x, parallel, 1e-4);
    look.light.falloff = 50;
    EXPECT_NEAR(sweepSlab(medium, look, 0.7, true, 4, thick).x, parallel / 5, 1e-3 * parallel);
    look.light.direction = glm::normalize(glm::dvec3(std::tan(0.3), 0, 1));
    EXPECT_EQ(sweepSlab(medium, look, 0.7, true, 4, thick).x, 0);
    look.light.direction = glm::normalize(glm::dvec3(std::tan(0.2), 0, 1));
    EXPECT_GT(sweepSlab(medium, look, 0.7, true, 4, thick).x, 0);
}

// A lamp in the middle of the slab's thickness: only what lies past it is lit, and by light that starts
// there.
TEST(PlainSweep, lampsInsideLightOnlyWhatLiesPastThem) {
    const double thick = 2.0;
    const Medium medium = slabOf({{0.8}}, thick);
    MediumLook look;
    look.model = MediumModel::Direct;
    look.light = sunAt(1);
    look.light.kind = MediumLight::Kind::Lamp;
    look.light.position = {0, 0, 0};
    look.light.coneAngle = 0.4;
    for (const bool forward : {true, false}) {
        const double half = 0.8;  // optical depth of half the slab, straight through
        const glm::dvec4 seen = sweepSlab(medium, look, 1, forward, 64, thick);
        const double expected =
            forward ? std::exp(-half) * shareOf(half, half, true) : shareOf(half, half, false);
        EXPECT_NEAR(seen.x, expected, 3e-4) << forward;  // the lamp's texels are not quite straight ahead
        EXPECT_NEAR(seen.w, std::exp(-1.6), 1e-6);
    }
}

// A surface in the slab: the gradient is along z, eye and light at known angles to it.
TEST(PlainSweep, surfacesAreBlinnPhongOfTheGradient) {
    const double thick = 1.0, x = 1.0 / 0.6;
    Uniform u{1.0};
    u.surface = 1;
    const Medium medium = slabOf({u}, thick);
    MediumLook look;
    look.model = MediumModel::Surface;
    look.light = sunAt(0.8);
    look.ambient = 0.125f;
    look.diffuse = 0.5f;
    look.specular = 0.25f;
    look.shininess = 8;
    const glm::dvec3 half = -glm::dvec3(0, 0.8, 0.6) - glm::dvec3(0.6, 0, 0.8);
    const double highlight = 0.25 * std::pow(std::abs(half.z) / glm::length(half), 8);
    const double shaded = 0.125 + 0.5 * 0.8 + highlight;
    EXPECT_NEAR(sweepSlab(medium, look, 0.6, true, 4, thick).x, shaded * -std::expm1(-x), 1e-5);
    // From the other side there is no highlight.
    EXPECT_NEAR(sweepSlab(medium, look, 0.6, false, 4, thick).x, (shaded - highlight) * -std::expm1(-x),
                1e-5);
    u.surface = 0.25;
    const Medium both = slabOf({u}, thick);
    EXPECT_NEAR(sweepSlab(both, look, 0.6, true, 4, thick).x, (0.75 + 0.25 * shaded) * -std::expm1(-x), 1e-5);
}

TEST(PlainSweep, surfacesWithoutAGradientAreDark) {
    Uniform u{1.0};
    u.surface = 1;
    std::vector<MediumPoint> points{{100, test::materialOf(u)}};
    const Medium medium(makeField({4, 4, 4}, 1, {0, 0, 0}, [](const glm::ivec3&) { return 100; }),
                        MediumTransfer(points, 1, "test"));
    MediumLook look;
    look.model = MediumModel::Surface;
    look.light = sun({0, 0, 1});
    const EyeView eye[] = {viewFrom({0, 0, -4}, {0, 0, 0}, 0.01, 3, 3)};
    const SweepGeometry g = makeSweepGeometry(medium, look, {}, eye, eye[0].eye);
    const glm::dvec4 seen = middleOf(plainSweep(medium, look, {}, g)[0]);
    EXPECT_EQ(seen.x, 0);
    EXPECT_NEAR(seen.w, std::exp(-1.0), 1e-5);
}

TEST(PlainSweep, viewDepthIsTheFirstSampleThatIsNotEmpty) {
    const double thick = 1.0;
    Uniform empty{0.0, glm::dvec3(0)};
    const Medium medium = slabOf({empty, {3.0}}, thick);
    MediumLook look;
    look.light = sunAt(1);
    SweepSetting setting;
    setting.slices = 10;
    for (const bool forward : {true, false}) {
        const SweepGeometry g = slabGeometry(medium, look, setting, 1, forward, thick);
        const MediumPicture picture = plainSweep(medium, look, setting, g)[0];
        // The eye is 10 away from the middle; the filled half begins there, or ends at 0.5.
        EXPECT_NEAR(picture.viewDepth.at(1, 1), forward ? 10.05 : 9.55, 1e-5) << forward;
    }
    const Medium none = slabOf({empty}, thick);
    EXPECT_EQ(none.bounds().empty(), true);
}

// Half a texel from the box's edge; beyond, texels see nothing and stay at 1.
TEST(PlainSweep, lightIsRightUpToATexelFromTheEdge) {
    const Medium medium = slabOf({{0.5}}, 1);
    MediumLook look;
    look.light = sun({0, 0, 1});
    look.model = MediumModel::Direct;
    SweepSetting setting;
    setting.slices = 16;
    setting.lightSize = 32;
    const EyeView eye[] = {viewFrom({96, 0, -10}, {96, 0, 0}, 1e-3, 3, 3)};
    const SweepGeometry g = makeSweepGeometry(medium, look, setting, eye, eye[0].eye);
    const glm::dvec4 seen = middleOf(plainSweep(medium, look, setting, g)[0]);
    EXPECT_NEAR(seen.x, shareOf(0.5, 0.5, true), 1e-4);
}

}  // namespace
}  // namespace stereonav
