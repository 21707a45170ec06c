// View depths from a millimetre to a million kilometres and beyond all measure: where the warp puts them,
// against double precision; and what the right eye shows of walls that far away.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/math/constants.h"
#include "engine/stereo/right_eye.h"
#include "engine/stereo/row_kernels.h"
#include "tests/oracle/warp_oracle.h"
#include "tests/support/analytic_scene.h"
#include "tests/support/stability_row.h"

namespace stereonav {
namespace {

using namespace test;

constexpr int kWidth = 1920;

StereoViews wideViews(double zeroParallax) {
    Lens lens;
    lens.width = kWidth;
    lens.height = 4;
    lens.verticalFov = 0.004;
    lens.nearDepth = 1e-4;
    return makeStereoViews(Pose{}, lens, {0.065, zeroParallax});
}

struct OneRow {
    Plane<std::uint32_t> leftColor{kWidth, 1}, color{kWidth, 1};
    Plane<float> leftDepth{kWidth, 1}, depth{kWidth, 1};
    Plane<std::uint8_t> holes{kWidth, 1};
    std::vector<float> column, inverse;
    std::vector<std::int32_t> source;

    OneRow() : column(kWidth + kRowPadding), inverse(column), source(column.size()) {}
    ResampleRow of(const StereoViews& views) {
        ResampleRow row{};
        row.leftColor = leftColor.row(0);
        row.leftDepth = leftDepth.row(0);
        row.color = color.row(0);
        row.depth = depth.row(0);
        row.holes = holes.row(0);
        row.width = kWidth;
        row.stride = leftColor.stride();
        row.shift = static_cast<float>(views.shiftAtInfinity);
        row.scale = static_cast<float>(views.parallaxScale);
        row.minStretch = 0.5f;
        row.maxStretch = 1.4f;
        row.reach = 1;
        row.column = column.data();
        row.inverse = inverse.data();
        row.source = source.data();
        return row;
    }
};

// column = (i + 0.5) + (shift - scale / z), each input and each operation rounded once to 2^-24 of its size:
// scale, z, quotient (three of the quotient), shift (one of it), difference, sum; i + 0.5 is exact.
double roundingOf(const StereoViews& views, double column, double depth) {
    const double quotient = views.parallaxScale / depth, difference = views.shiftAtInfinity - quotient;
    return 0x1p-24 * (1 + 1e-6) *
           (3 * quotient + views.shiftAtInfinity + std::abs(difference) + std::abs(column));
}

class DepthRow : public testing::TestWithParam<double> {};

TEST_P(DepthRow, ColumnsAreThoseOfDoublePrecision) {
    const double depth = GetParam();
    StabilityRow row("depth/columns/" + shortNumber(depth),
                     "a row of 1,920 pixels at view depth " + shortNumber(depth) + " m, every kernel",
                     "error of the right eye's column over the rounding of its terms", 1, "");
    for (const double zeroParallax : {1.95, 0.5 * std::clamp(depth, 1e-3, 1e9)}) {
        const StereoViews views = wideViews(zeroParallax);
        for (const SimdTarget target : simdTargets()) {
            OneRow buffers;
            for (int i = 0; i < kWidth; ++i) buffers.leftDepth.at(i, 0) = static_cast<float>(depth);
            resampler(target)(buffers.of(views));
            for (int i = 0; i < kWidth; ++i) {
                const double truth = views.rightColumn(i + 0.5, depth);
                row.saw(std::abs(buffers.column[i] - truth) / roundingOf(views, truth, depth));
            }
        }
    }
}

// A wall across the view: all pixels of it move by the same. What is not moved out of sight is warped, and
// shows the wall at its depth.
TEST_P(DepthRow, AWallIsWarpedAtItsDepth) {
    const double depth = GetParam();
    StabilityRow row(
        "depth/wall/" + shortNumber(depth),
        "a wall at view depth " + shortNumber(depth) + " m, the zero-parallax plane at twice that",
        "relative error of the right eye's depth, all methods that fill", 0x1p-23, "");
    Lens lens;
    lens.width = 97;
    lens.height = 5;
    lens.nearDepth = 1e-4;
    const double zero = std::clamp(2 * depth, 1e-3, 2e9);
    const StereoViews views = makeStereoViews(Pose{}, lens, {0.02 * zero, zero});
    const AnalyticScene scene(
        std::isinf(depth) ? std::vector<Shape>{} : std::vector<Shape>{plane({0, 0, -depth}, {0, 0, 1})},
        1e-2 / zero);
    const EyeImage left = castEye(scene, views.left);
    for (const RightEyeMethod method :
         {RightEyeMethod::Paper, RightEyeMethod::Linear, RightEyeMethod::Cubic}) {
        WarpSetting setting;
        setting.method = method;
        RightEye eye;
        EyeImage right;
        eye.render(scene, views, left, setting, right);
        for (int y = 0; y < lens.height; ++y)
            for (int x = 0; x < lens.width; ++x) {
                const double seen = right.viewDepth.at(x, y);
                row.saw(std::isinf(depth) ? (std::isinf(seen) ? 0 : kInfinity)
                                          : std::abs(seen - depth) / depth);
            }
    }
}

TEST_P(DepthRow, APixelsPlaceIsProjectedBackToIt) {
    const double depth = std::isinf(GetParam()) ? 1e15 : GetParam();
    // Place, difference and dot product are rounded to 2^-53 of the place's distance from the world's
    // origin a few times; a pixel is 1 / width of the window: 16 such roundings.
    const StereoViews views = wideViews(1.95);
    const double bound = 16 * 0x1p-53 * kWidth * (1 + 0.065 / depth / (views.left.xMax - views.left.xMin));
    StabilityRow row("depth/project/" + shortNumber(GetParam()),
                     "pixels to places at view depth " + shortNumber(depth) + " m and back",
                     "way between a pixel and where its place is projected to", bound, "pixels");
    for (const EyeView& view : {views.left, views.right})
        for (int x = 0; x < kWidth; x += 7) {
            const glm::dvec3 back = view.project(view.pointAt(x + 0.5, 1.5, depth));
            row.saw(std::hypot(back.x - (x + 0.5), back.y - 1.5));
            row.saw(std::abs(back.z - depth) / depth);
        }
}

INSTANTIATE_TEST_SUITE_P(Stability, DepthRow,
                         testing::Values(1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9,
                                         kInfinity),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

}  // namespace
}  // namespace stereonav
