// The fast sweep of media at its extremes: optical depths from a millionth to a million and 1 to 10,000
// slices against the closed form of a homogeneous slab, any number of threads, views that sweep grazes,
// denormals.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "engine/medium/sweep/medium_sweep.h"
#include "tests/medium/sweep_scenes.h"
#include "tests/oracle/plain_sweep.h"
#include "tests/stability/slab_formulas.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/stability_row.h"

namespace stereonav {
namespace {

using namespace test;

// Light that eyes read is kept in 15 bits: of what a slab takes in, at most the medium's opacity, each
// reading is off by 2^-16, and by as much again where it is interpolated. The rest is float: each slab rounds
// what is left and the sum of the light, by 2^-24 and at most twice; exponentials by polynomials are good to
// 2^-20 of the value, times the depth for its exponent. Forward sweeps stop where less than 1/1024 is left.
void sawErrors(const glm::dvec4& seen, double depth, bool forward, int slices, StabilityRow& row) {
    const double x = depth / kEyeCosine, y = depth / kLightCosine;
    const double light = shareOf(x, y, forward), left = std::exp(-x), opacity = -std::expm1(-x);
    const bool stops = forward && x > std::log(1024.0);
    const double rounding = 0x1p-20 * (1 + x) + slices * 0x1p-23;
    row.saw(std::abs(seen.x - light) /
            (opacity * 0x1p-15 + light * rounding +
             (stops ? std::pow(1 / 1024.0, 1 + kEyeCosine / kLightCosine) : 1e-38)));
    row.saw(std::abs(seen.w - left) / (left * rounding + 0x1p-22 + (stops ? 1 / 1024.0 : 0)));
}

glm::dvec4 sweptSlab(double depth, bool forward, int slices, SimdTarget target) {
    const Medium medium = slabOf({{depth / kThick}}, kThick);
    MediumLook look;
    look.model = MediumModel::Direct;
    look.light = sun({0.6, 0, kLightCosine});
    SweepSetting setting;
    setting.slices = slices;
    setting.coneAngle = 0;
    const SweepGeometry g = slabGeometry(medium, look, setting, kEyeCosine, forward, kThick);
    MediumPicture picture;
    MediumSweep(medium, target).render(look, setting, g, 0, {&picture, 1});
    return glm::dvec4(picture.light.at(1, 1));
}

class FastDepthRow : public testing::TestWithParam<double> {};

TEST_P(FastDepthRow, SweptSlabIsTheClosedForm) {
    for (const bool forward : {true, false}) {
        StabilityRow row(std::string("optical-depth/fast-") + (forward ? "forward/" : "backward/") +
                             shortNumber(GetParam()),
                         "a slab of optical depth " + shortNumber(GetParam()) + ", swept fast " +
                             (forward ? "with" : "against") + " the view in 1, 7 and 64 slices",
                         "error over 15 bits of light, rounding and the early stop", 1, "");
        for (const SimdTarget target : simdTargets())
            for (const int slices : {1, 7, 64})
                sawErrors(sweptSlab(GetParam(), forward, slices, target), GetParam(), forward, slices, row);
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, FastDepthRow,
                         testing::Values(1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5,
                                         1e6),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

class FastSliceRow : public testing::TestWithParam<int> {};

TEST_P(FastSliceRow, AnyNumberIsTheClosedForm) {
    for (const bool forward : {true, false}) {
        StabilityRow row(
            std::string("slices/fast-") + (forward ? "forward/" : "backward/") + std::to_string(GetParam()),
            "a slab of optical depth 1 swept fast in " + std::to_string(GetParam()) + " slices, " +
                (forward ? "with" : "against") + " the view",
            "error over 15 bits of light and rounding", 1, "");
        for (const SimdTarget target : simdTargets())
            sawErrors(sweptSlab(1, forward, GetParam(), target), 1, forward, GetParam(), row);
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, FastSliceRow, testing::Values(1, 2, 10, 100, 1000, 10000));

// ---- a cloud, in stereo

Medium cloud(double steep) {
    auto field = makeField({15, 13, 11}, 2.0, glm::dvec3(0), [](const glm::ivec3& v) {
        return 400 + 400 * std::sin(0.9 * v.x) * std::sin(0.7 * v.y + 1) * std::sin(0.8 * v.z + 2);
    });
    MediumMaterial clear, dense;
    clear.opacity = 0;
    dense.opacity = -std::expm1(-steep);
    dense.color = {0.9f, 0.7f, 0.5f};
    return Medium(field, MediumTransfer({{300, clear}, {700, dense}}, 0.1, "test"));
}

std::vector<MediumPicture> sweep(const Medium& medium, const MediumLook& look, SimdTarget target,
                                 const glm::dvec3& eye) {
    SweepSetting setting;
    setting.slices = 40;
    setting.lightSize = 48;
    const EyeView eyes[] = {viewFrom(eye - glm::dvec3(0.03, 0, 0), {0, 0, 0}, 0.5, 37, 29),
                            viewFrom(eye + glm::dvec3(0.03, 0, 0), {0, 0, 0}, 0.5, 37, 29)};
    std::vector<MediumPicture> pictures(2);
    MediumSweep(medium, target).render(look, setting, eyes, eye, 0, pictures);
    return pictures;
}

void countDifferent(const std::vector<MediumPicture>& a, const std::vector<MediumPicture>& b,
                    StabilityRow& row) {
    for (std::size_t e = 0; e < a.size(); ++e)
        for (int y = 0; y < a[e].light.height(); ++y)
            for (int x = 0; x < a[e].light.width(); ++x)
                row.count(std::memcmp(&a[e].light.at(x, y), &b[e].light.at(x, y), sizeof(glm::vec4)) != 0 ||
                          a[e].viewDepth.at(x, y) != b[e].viewDepth.at(x, y));
}

class SweepThreadsRow : public testing::TestWithParam<int> {};

TEST_P(SweepThreadsRow, GiveTheSameBits) {
    StabilityRow row("threads/sweep/" + std::to_string(GetParam()),
                     "a cloud in stereo, on " + std::to_string(GetParam()) + " threads and on one",
                     "pixels that differ", 0, "pixels");
    row.count(0);
    const Medium medium = cloud(0.8);
    MediumLook look;
    look.light = sun({0.5, 0.3, -0.8});
    const ThreadsBefore before;
    for (const glm::dvec3 eye : {glm::dvec3(0.3, -3, 1), glm::dvec3(-2, 1.5, -2)}) {
        setThreadCount(1);
        const auto one = sweep(medium, look, SimdTarget::Auto, eye);
        setThreadCount(GetParam());
        countDifferent(one, sweep(medium, look, SimdTarget::Auto, eye), row);
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, SweepThreadsRow, testing::Values(2, 3, 8, 64));

class SweepSoundRow : public testing::TestWithParam<double> {};

// Every share is between 0 and 1 (V5, V6), and so is what a medium of colour up to 1 sends of a light of 1,
// directly and scattered: at most the light and its scattered part, times the opacity.
TEST_P(SweepSoundRow, LightStaysWithinItsBounds) {
    StabilityRow row("sweep/sound/" + shortNumber(GetParam()),
                     "a cloud of extinction " + shortNumber(GetParam()) +
                         " a decimetre, lit from six sides and by a lamp within it",
                     "light below 0, above what is sent, or none; as a number", 1e-3, "");
    const Medium medium = cloud(GetParam());
    std::vector<MediumLight> lights;
    for (const glm::dvec3 way : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0),
                                 glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)})
        lights.push_back(sun(way));
    MediumLight lamp;
    lamp.kind = MediumLight::Kind::Lamp;
    lamp.position = {0.1, 0, 0.1};
    lights.push_back(lamp);
    for (const MediumLight& light : lights)
        for (const glm::dvec3 eye : {glm::dvec3(0, -3, 0), glm::dvec3(0.2, 0.1, 0)}) {
            MediumLook look;
            look.light = light;
            for (const SimdTarget target : simdTargets())
                for (const MediumPicture& p : sweep(medium, look, target, eye))
                    for (int y = 0; y < p.light.height(); ++y)
                        for (int x = 0; x < p.light.width(); ++x) {
                            const glm::dvec4 v(p.light.at(x, y));
                            for (int k = 0; k < 3; ++k) {
                                row.saw(-v[k]);
                                row.saw(v[k] - 2 * (1 - v.w));
                            }
                            row.saw(-v.w);
                            row.saw(v.w - 1);
                        }
        }
}

INSTANTIATE_TEST_SUITE_P(Stability, SweepSoundRow, testing::Values(1e-6, 1e-3, 1.0, 10.0),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

// ---- pictures of one pixel, one row, one column, and long ones

struct SweepSize {
    int width, height;
    std::string text() const { return std::to_string(width) + "x" + std::to_string(height); }
};

class SweepSizeRow : public testing::TestWithParam<SweepSize> {};

// Compares with the reference model (plain_sweep.h). Each of 24 slabs reads light in 15 bits, twice, where
// two texels are mixed; a forward sweep stops where less than 1/1024 is left.
TEST_P(SweepSizeRow, IsAsByTheBook) {
    StabilityRow row("image/sweep/" + GetParam().text(),
                     "a cloud in stereo in " + GetParam().text() + " pixels, as by the book",
                     "difference of light, of a light of 1", 1.0 / 1024 + 24 * 0x1p-15, "");
    const Medium medium = cloud(0.6);
    MediumLook look;
    SweepSetting setting;
    setting.slices = 24;
    setting.lightSize = 32;
    for (const glm::dvec3 way : {glm::dvec3(0.5, 0.3, -0.8), glm::dvec3(0.1, 1, 0.1)}) {
        look.light = sun(way);
        const glm::dvec3 eye(0.3, -3, 1);
        EyeView eyes[] = {
            viewFrom(eye - glm::dvec3(0.03, 0, 0), {0, 0, 0}, 0.5, GetParam().width, GetParam().height),
            viewFrom(eye + glm::dvec3(0.03, 0, 0), {0, 0, 0}, 0.5, GetParam().width, GetParam().height)};
        for (EyeView& view : eyes) view.xMin = view.yMin = -0.3, view.xMax = view.yMax = 0.3;
        const SweepGeometry geometry = makeSweepGeometry(medium, look, setting, eyes, eye);
        const std::vector<MediumPicture> truth = plainSweep(medium, look, setting, geometry);
        for (const SimdTarget target : simdTargets()) {
            std::vector<MediumPicture> pictures(2);
            MediumSweep(medium, target).render(look, setting, geometry, 0, pictures);
            float brightest = 0;
            for (std::size_t e = 0; e < 2; ++e)
                for (int y = 0; y < GetParam().height; ++y)
                    for (int x = 0; x < GetParam().width; ++x)
                        for (int c = 0; c < 4; ++c) {
                            row.saw(std::abs(double(pictures[e].light.at(x, y)[c]) -
                                             double(truth[e].light.at(x, y)[c])));
                            if (c < 3) brightest = std::max(brightest, truth[e].light.at(x, y)[c]);
                        }
            EXPECT_GT(brightest, 0.01f) << "nothing to compare";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, SweepSizeRow,
                         testing::Values(SweepSize{1, 1}, SweepSize{1, 2}, SweepSize{2, 1}, SweepSize{1, 97},
                                         SweepSize{97, 1}, SweepSize{15, 3}, SweepSize{17, 3},
                                         SweepSize{4096, 1}, SweepSize{1, 4096}),
                         [](const auto& given) { return testName(given.param.text()); });

}  // namespace
}  // namespace stereonav
