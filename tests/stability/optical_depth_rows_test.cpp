// Optical depths from a millionth to a million: the translucent caster and the sweep of media against the
// closed form of a homogeneous slab; any number of slices from 1 to 10,000.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/medium/sweep_scenes.h"
#include "tests/oracle/plain_composite.h"
#include "tests/stability/slab_formulas.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/stability_row.h"

namespace stereonav {
namespace {

using namespace test;

// (1 - exp(-z)) / z
glm::dvec4 plainSlab(double depth, bool forward, int slices) {
    const Medium medium = slabOf({{depth / kThick}}, kThick);
    MediumLook look;
    look.model = MediumModel::Direct;
    look.light = sun({0.6, 0, kLightCosine});
    SweepSetting setting;
    setting.slices = slices;
    setting.coneAngle = 0;
    const SweepGeometry g = slabGeometry(medium, look, setting, kEyeCosine, forward, kThick);
    return glm::dvec4(plainSweep(medium, look, setting, g)[0].light.at(1, 1));
}

// Error of light and of what is left of the background, over what is allowed. Extinctions are floats, the
// table they come from is built from logarithms of floats: some 8 roundings of 2^-24, which an exponent of
// x takes x-fold. A forward sweep stops where less than 1/1024 is left: so much of the background, and that
// times what light gets there of the medium's.
void sawErrors(const glm::dvec4& seen, double depth, bool forward, StabilityRow& row) {
    const double x = depth / kEyeCosine, y = depth / kLightCosine;
    const double light = shareOf(x, y, forward), left = std::exp(-x);
    const bool stops = forward && x > std::log(1024.0);
    const double rounding = 8 * 0x1p-24;
    const double lightBound = light * rounding * (1 + (forward ? 0 : x)) +
                              (stops ? std::pow(1 / 1024.0, 1 + kEyeCosine / kLightCosine) : 1e-38);
    const double leftBound = left * rounding * (1 + x) + (stops ? 1 / 1024.0 : 1e-38);
    row.saw(std::abs(seen.x - light) / lightBound);
    row.saw(std::abs(seen.w - left) / leftBound);
}

class OpticalDepthRow : public testing::TestWithParam<double> {};

TEST_P(OpticalDepthRow, SweptSlabIsTheClosedForm) {
    for (const bool forward : {true, false}) {
        StabilityRow row(
            std::string("optical-depth/") + (forward ? "forward/" : "backward/") + shortNumber(GetParam()),
            "a slab of optical depth " + shortNumber(GetParam()) + ", swept " +
                (forward ? "with" : "against") + " the view in 1, 7 and 64 slices",
            "error over rounding and the early stop", 1, "");
        for (const int slices : {1, 7, 64})
            sawErrors(plainSlab(GetParam(), forward, slices), GetParam(), forward, row);
    }
}

// ---- the translucent caster

VolumeScene glassScene(const VolumeFrame& frame, double extinction) {
    VolumeScene scene;
    scene.field = GreyVolume(frame);
    // A layer of the reference length takes 1 - 1/e.
    const TransferPoint point{0, glm::vec3(1.0f), -std::expm1(-1.0)};
    scene.look.transfer = TransferFunction({point, {1, point.color, point.opacity}}, 1 / extinction, "test");
    scene.look.ambient = 1;
    scene.look.diffuse = scene.look.specular = scene.look.falloff = 0;
    SurfaceSetting setting{0, -1, 2, nullptr};
    Progress quiet;
    scene.cells = findSurfaceCells(scene.field, setting, quiet);
    return scene;
}

TEST_P(OpticalDepthRow, CastSlabIsTheClosedForm) {
    const double depth = GetParam();
    const VolumeFrame frame = frameOf({17, 17, 17}, glm::dvec3(0.001));
    const double length = 0.016, extinction = depth / length;
    const VolumeScene scene = glassScene(frame, extinction);
    EyeView view;
    view.eye = view.head = {0.008, 0.008, 0.03};
    view.xMin = view.yMin = -1e-3, view.xMax = view.yMax = 1e-3;
    view.width = view.height = 5;
    view.nearDepth = 0.001;
    StabilityRow plain("optical-depth/plain-cast/" + shortNumber(depth),
                       "a cube of optical depth " + shortNumber(depth) + ", cast plainly",
                       "error of the way that the light left speaks of", 0.5e-3, "m");
    StabilityRow fast("optical-depth/cast/" + shortNumber(depth),
                      "a cube of optical depth " + shortNumber(depth) + ", cast by each instruction set",
                      "colour beyond a sample more or less", 1, "levels of 1,023");
    // Samples are half a voxel apart: one more or less falls into the volume. Rays end where less than
    // 1/1024 is left: a way of more is all that is known then.
    const double step = 0.5e-3;
    const PlainComposite seen =
        compositePlain(scene.field, scene.look, {view.eye, {0, 0, -1}, view.nearDepth}, view.head, 0.5);
    const double way = -std::log(seen.left) / extinction;
    plain.saw(seen.left < 1 / 1024.0 && length * extinction > std::log(1024.0) ? 0 : std::abs(way - length));
    const auto level = [](double light) { return std::sqrt(light) * 1023; };
    const double least = level(-std::expm1(-extinction * (length - step))) - (depth > 6 ? 1 : 0.0);
    const double most = level(-std::expm1(-extinction * (length + step)));
    for (const SimdTarget target : simdTargets()) {
        const EyeImage image = castPicture(VolumeRenderer(scene, {target}), view);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 5; ++x)
                for (int shift = 0; shift < 30; shift += 10) {
                    const double got = image.color.at(x, y) >> shift & 1023u;
                    fast.saw(std::max({least - got, got - most, 0.0}));
                }
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, OpticalDepthRow,
                         testing::Values(1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5,
                                         1e6),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

// ---- slices

class SliceRow : public testing::TestWithParam<int> {};

TEST_P(SliceRow, AnyNumberIsTheClosedForm) {
    for (const bool forward : {true, false}) {
        StabilityRow row(
            std::string("slices/") + (forward ? "forward/" : "backward/") + std::to_string(GetParam()),
            "a slab of optical depth 1 in " + std::to_string(GetParam()) + " slices, " +
                (forward ? "with" : "against") + " the view",
            "error over rounding", 1, "");
        sawErrors(plainSlab(1, forward, GetParam()), 1, forward, row);
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, SliceRow, testing::Values(1, 2, 10, 100, 1000, 10000));

}  // namespace
}  // namespace stereonav
