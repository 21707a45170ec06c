// The row warps: vector kernels against the scalar oracle bit for bit, the three kinds of gap, the
// fixed-point arithmetic.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "engine/stereo/packed_resample.h"
#include "engine/stereo/paint_row.h"
#include "engine/stereo/row_kernels.h"
#include "tests/oracle/warp_oracle.h"
#include "tests/stereo/row_buffers.h"

namespace stereonav {
namespace {

// Smooth ground with jumps, spikes and sky.
void fillRandomly(RowBuffers& row, std::mt19937& random, double skyShare) {
    std::uniform_real_distribution<double> unit(0, 1);
    double depth = 5 + 20 * unit(random), slope = 0;
    bool sky = false;
    for (int i = 0; i < row.width; ++i) {
        if (unit(random) < 0.03) depth = 2 + 60 * unit(random) * unit(random);
        if (unit(random) < 0.05) slope = 0.1 * (unit(random) - 0.5);
        if (unit(random) < 0.04) sky = unit(random) < skyShare;
        depth = std::max(1.0, depth * (1 + slope * 0.1));
        const bool spike = unit(random) < 0.01;
        row.leftDepth.at(i, 0) = sky ? kSky : static_cast<float>(spike ? 1.0 : depth);
        row.leftColor.at(i, 0) = static_cast<std::uint32_t>(random()) & 0x3fffffffu;
        row.spread.at(i, 0) = unit(random) < 0.3 ? static_cast<float>(unit(random) * depth) : 0.0f;
    }
}

struct KernelCase {
    int width;
    float shift, scale;
    double skyShare;
};

std::vector<KernelCase> kernelCases() {
    std::vector<KernelCase> cases;
    for (const int width : {1, 2, 3, 15, 16, 17, 31, 33, 48, 130, 500, 1000, 1283})
        for (const float scale : {0.0f, 1e-6f, 1.0f, 40.0f, 400.0f, 1e4f, 1e9f})
            for (const double sky : {0.0, 0.5, 1.0}) cases.push_back({width, scale / 20, scale, sky});
    return cases;
}

void expectSameRow(const RowBuffers& expected, const RowBuffers& actual, const std::string& what) {
    for (int p = 0; p < expected.width; ++p) {
        ASSERT_EQ(expected.holes.at(p, 0), actual.holes.at(p, 0)) << what << " pixel " << p;
        ASSERT_EQ(expected.color.at(p, 0), actual.color.at(p, 0)) << what << " pixel " << p;
        ASSERT_EQ(expected.depth.at(p, 0), actual.depth.at(p, 0)) << what << " pixel " << p;
        ASSERT_EQ(expected.source[p], actual.source[p]) << what << " pixel " << p;
        if (!expected.hole(p)) {
            const int s = expected.source[p];
            ASSERT_EQ(expected.column[s], actual.column[s]) << what << " pixel " << p;
            ASSERT_EQ(expected.inverse[s], actual.inverse[s]) << what << " pixel " << p;
        }
    }
}

struct Found {
    long long warped = 0, holes = 0;
};

// mode: 18 ways to link and to mix; minStretch and maxStretch as given.
void compareWithOracle(ResampleFunction kernel, const RowBuffers& given, const KernelCase& c, int mode,
                       float minStretch, float maxStretch, Found& found) {
    const bool cubic = mode % 2 == 1, surface = mode / 6 == 1, spreads = mode / 6 == 2;
    const int reach = cubic ? 2 : mode / 2 % 3;
    RowBuffers oracle = given, actual = given;
    const auto rowOf = [&](RowBuffers& buffers) {
        ResampleRow row = buffers.resample(c.shift, c.scale, cubic, reach, surface, minStretch, maxStretch);
        if (spreads) row.leftSpread = buffers.spread.row(0), row.mostSpread = 0.5f;
        return row;
    };
    resampleRowOracle(rowOf(oracle));
    kernel(rowOf(actual));
    for (int p = 0; p < c.width; ++p) ++(oracle.hole(p) ? found.holes : found.warped);
    expectSameRow(oracle, actual,
                  "width " + std::to_string(c.width) + " scale " + std::to_string(c.scale) + " mode " +
                      std::to_string(mode));
}

TEST(ResampleKernels, everySetGivesTheBitsOfTheOracle) {
    for (const SimdTarget target : simdTargets()) {
        SCOPED_TRACE(nameOf(target));
        std::mt19937 random(1);
        Found found;
        for (const KernelCase& c : kernelCases())
            for (int mode = 0; mode < 18; ++mode) {
                RowBuffers row(c.width);
                fillRandomly(row, random, c.skyShare);
                compareWithOracle(resampler(target), row, c, mode, 0.5f, 1.1f, found);
                if (HasFatalFailure()) return;
            }
        EXPECT_GT(found.warped, 50000);
        EXPECT_GT(found.holes, 50000);
    }
}

// Sources of one block come from far apart: many left pixels to a right one, as many links as there can be,
// and depths down to what divides to infinity.
TEST(ResampleKernels, crowdedRowsAndExtremeDepthsGiveTheBitsOfTheOracle) {
    constexpr float kMost = std::numeric_limits<float>::infinity();
    const float extremes[] = {1e-42f, 1e-30f, 1e-3f, 1.0f, 1e6f, 1e30f, kSky};
    for (const SimdTarget target : simdTargets()) {
        SCOPED_TRACE(nameOf(target));
        std::mt19937 random(5);
        Found found;
        for (int width = 1; width <= 70; ++width)
            for (int mode = 0; mode < 18; ++mode) {
                RowBuffers row(width);
                fillRandomly(row, random, 0.1);
                const bool crowded = mode % 3 != 0;
                for (int i = 0; i < width; ++i)
                    if (crowded)  // five left pixels to a right one
                        row.leftDepth.at(i, 0) = 100 / (10 + 0.8f * static_cast<float>(i));
                    else if (random() % 3 == 0)
                        row.leftDepth.at(i, 0) = extremes[random() % 7];
                const KernelCase c{width, crowded ? 20.0f : 3.0f, 100, 0};
                compareWithOracle(resampler(target), row, c, mode, 0.0f, kMost, found);
                if (HasFatalFailure()) return;
            }
        EXPECT_GT(found.warped, 2000);
        EXPECT_GT(found.holes, 2000);
    }
}

TEST(PackedResample, interpolatesWithinHalfALevelOfTheExactValue) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int n = 0; n < 20000; ++n) {
        std::uint32_t taps[4];
        for (auto& tap : taps) tap = static_cast<std::uint32_t>(random()) & 0x3fffffffu;
        const float t = unit(random);
        const double d = t;
        const double w[4] = {((-0.5 * d + 1) * d - 0.5) * d, (1.5 * d - 2.5) * d * d + 1,
                             ((-1.5 * d + 2) * d + 0.5) * d, (0.5 * d - 0.5) * d * d};
        const std::uint32_t cubic = cubicPacked(taps, t), linear = lerpPacked(taps[1], taps[2], t);
        for (int shift = 0; shift < 30; shift += 10) {
            double exact = 0;
            for (int k = 0; k < 4; ++k) exact += w[k] * (taps[k] >> shift & 1023u);
            const double between = (1 - d) * (taps[1] >> shift & 1023u) + d * (taps[2] >> shift & 1023u);
            ASSERT_NEAR(cubic >> shift & 1023u, std::clamp(exact, 0.0, 1023.0), 0.75) << "t " << t;
            ASSERT_NEAR(linear >> shift & 1023u, between, 0.6) << "t " << t;
        }
    }
}

TEST(PackedResample, keepsTheEndsExactly) {
    std::mt19937 random(3);
    for (int n = 0; n < 2000; ++n) {
        std::uint32_t taps[4];
        for (auto& tap : taps) tap = static_cast<std::uint32_t>(random()) & 0x3fffffffu;
        ASSERT_EQ(cubicPacked(taps, 0), taps[1]);
        ASSERT_EQ(cubicPacked(taps, 1), taps[2]);
        ASSERT_EQ(lerpPacked(taps[1], taps[2], 0), taps[1]);
        ASSERT_EQ(lerpPacked(taps[1], taps[2], 1), taps[2]);
    }
}

// A near block before a far wall, as drawn by each method. Far moves by +1, near by -4.
RowBuffers blockRow() {
    RowBuffers row(60);
    for (int i = 0; i < row.width; ++i) {
        const bool near = i >= 20 && i < 35;
        row.leftDepth.at(i, 0) = near ? 10.0f : 60.0f;
        row.leftColor.at(i, 0) = near ? gray(900) : gray(200);
    }
    return row;
}
constexpr float kBlockScale = 60, kBlockShift = 2;

void expectThreeGaps(const RowBuffers& row) {
    // left-end gap: the far wall begins at column 1; the near block lies at 16 .. 31, so that pixels
    // 31 .. 35 open behind it; the right end is covered.
    EXPECT_TRUE(row.hole(0));
    for (int p = 4; p < 14; ++p) EXPECT_FALSE(row.hole(p)) << p;
    for (int p = 18; p < 29; ++p) EXPECT_FALSE(row.hole(p)) << p;
    for (int p = 32; p < 35; ++p) EXPECT_TRUE(row.hole(p)) << p;
    for (int p = 39; p < 57; ++p) EXPECT_FALSE(row.hole(p)) << p;
}

TEST(Gaps, inverseMethodsLeaveTheLeftEndAndTheMiddle) {
    RowBuffers row = blockRow();
    resampleRowOracle(row.resample(kBlockShift, kBlockScale, true));
    expectThreeGaps(row);
    for (int p = 4; p < 14; ++p) EXPECT_EQ(row.color.at(p, 0), gray(200));
    for (int p = 18; p < 29; ++p) EXPECT_EQ(row.color.at(p, 0), gray(900));
}

TEST(Gaps, splatsLeaveTheLeftEndAndTheMiddle) {
    RowBuffers row = blockRow();
    splatRow(row.splat(kBlockShift, kBlockScale));
    expectThreeGaps(row);
    for (int p = 4; p < 14; ++p) EXPECT_EQ(row.color.at(p, 0), gray(200));
    for (int p = 18; p < 29; ++p) EXPECT_EQ(row.color.at(p, 0), gray(900));
}

TEST(Gaps, theRightEndOpensWhenEverythingMovesLeft) {
    for (const bool splats : {false, true}) {
        RowBuffers row(40);
        for (int i = 0; i < row.width; ++i) {
            row.leftDepth.at(i, 0) = 10.0f;
            row.leftColor.at(i, 0) = gray(500);
        }
        if (splats)
            splatRow(row.splat(0, 60));  // six pixels to the left
        else
            resampleRowOracle(row.resample(0, 60, true));
        for (int p = 1; p < 30; ++p) EXPECT_FALSE(row.hole(p)) << splats << " " << p;
        for (int p = 35; p < 40; ++p) EXPECT_TRUE(row.hole(p)) << splats << " " << p;
    }
}

// A plane 1 / z = a + b x seen by the left eye at column x is seen by the right eye at x + shift - scale / z.
TEST(Surface, depthBetweenSurvivorsIsThatOfThePlane) {
    const float shift = 3, scale = 80;
    for (const double slope : {-2e-4, 1e-4, 4e-4}) {
        RowBuffers row(300);
        for (int i = 0; i < row.width; ++i)
            row.leftDepth.at(i, 0) = static_cast<float>(1 / (0.15 + slope * (i + 0.5)));
        resampleRowOracle(row.resample(shift, scale, false, 1, true));
        int warped = 0;
        for (int p = 0; p < row.width; ++p) {
            if (row.hole(p)) continue;
            // x solves p + 0.5 = x + shift - scale (0.15 + slope x)
            const double x = (p + 0.5 - shift + scale * 0.15) / (1 - scale * slope);
            const double truth = 1 / (0.15 + slope * x), d = slope * truth;
            ASSERT_NEAR(row.depth.at(p, 0), truth, (d * d / 4 + 2e-6) * truth) << p;
            ++warped;
        }
        EXPECT_GT(warped, 250);
        resampleRowOracle(row.resample(shift, scale, false, 1, false));
        for (int p = 0; p < row.width; ++p) {
            const double x = (p + 0.5 - shift + scale * 0.15) / (1 - scale * slope);
            if (!row.hole(p)) {
                ASSERT_LE(row.depth.at(p, 0), (1 + 2e-6) / (0.15 + slope * x)) << "never too far";
            }
        }
    }
}

TEST(Surface, noLinkJoinsSurfaceAndSky) {
    RowBuffers row(60);  // far surface and sky: a third of a pixel of parallax between them
    for (int i = 0; i < row.width; ++i) {
        row.leftDepth.at(i, 0) = i >= 20 && i < 40 ? 30.0f : kSky;
        row.leftColor.at(i, 0) = i >= 20 && i < 40 ? gray(1000) : 0u;
    }
    int mixed = 0;
    for (const bool surface : {true, false}) {
        resampleRowOracle(row.resample(2, 10, false, 0, surface, 0.5f, 1.4f));
        for (int p = 2; p < 58; ++p) {
            const bool between = !row.hole(p) && row.color.at(p, 0) != 0 && row.color.at(p, 0) != gray(1000);
            if (surface) {
                EXPECT_FALSE(between) << p;
                EXPECT_EQ(row.hole(p), p == 21 || p == 41) << p;
            }
            mixed += between;
        }
    }
    EXPECT_GT(mixed, 0) << "colours of surface and sky are blended";
}

TEST(Splats, skyIsNotReprojected) {
    RowBuffers row(40);
    for (int i = 0; i < row.width; ++i) {
        row.leftDepth.at(i, 0) = i < 20 ? kSky : 30.0f;
        row.leftColor.at(i, 0) = gray(300);
    }
    splatRow(row.splat(2, 60));
    for (int p = 0; p < 18; ++p) EXPECT_TRUE(row.hole(p)) << p;
    for (int p = 21; p < 39; ++p) EXPECT_FALSE(row.hole(p)) << p;
}

TEST(Splats, stretchedBeyondTheThresholdIsAHole) {
    // A steep surface: neighbouring left pixels land five right pixels apart.
    RowBuffers row(64);
    for (int i = 0; i < row.width; ++i) {
        const float wanted = 5 * (static_cast<float>(i) - 32) + 32;  // right column
        row.leftDepth.at(i, 0) = 1000 / (static_cast<float>(i) + 200 - wanted);
        row.leftColor.at(i, 0) = gray(700);
    }
    splatRow(row.splat(200 - 0.5f, 1000));
    int holes = 0, covered = 0;
    for (int p = 10; p < 54; ++p) {
        if (row.hole(p)) {
            ++holes;
        } else {
            ++covered;
            ASSERT_EQ(row.color.at(p, 0), gray(700));
        }
    }
    EXPECT_GT(holes, covered);
    EXPECT_GT(covered, 4);
}

TEST(Splats, blendFrontToBack) {
    // Left pixel 11 lands on 8, before the far pixels 7, 8, 9: its colour must dominate there.
    RowBuffers row(24);
    for (int i = 0; i < row.width; ++i) {
        row.leftDepth.at(i, 0) = i >= 11 && i < 15 ? 10.0f : 1e6f;
        row.leftColor.at(i, 0) = i >= 11 && i < 15 ? gray(1000) : gray(0);
    }
    splatRow(row.splat(0, 30));
    for (int p = 9; p < 11; ++p) EXPECT_GT(row.color.at(p, 0) & 1023u, 970u) << p;
    EXPECT_LT(row.color.at(6, 0) & 1023u, 30u);
}

}  // namespace
}  // namespace stereonav
