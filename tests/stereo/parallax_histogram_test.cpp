// Every pixel counts, and counts where double precision puts it: against plain loops, on every instruction
// set.
#include "engine/stereo/parallax_histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/base/parallel.h"
#include "engine/image/eye_image.h"

namespace stereonav {
namespace {

StereoViews viewsOf(int width, int height, const StereoSetting& setting) {
    Lens lens;
    lens.width = width;
    lens.height = height;
    return makeStereoViews({}, lens, setting);
}

// The definition, pixel by pixel.
ParallaxSeen plainlySeen(const StereoViews& views, const Plane<float>& depth) {
    ParallaxSeen seen;
    bool any = false;
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x) {
            const double z = static_cast<double>(depth.at(x, y));
            if (!(z > 0)) {
                ++seen.histogram.unknown;
                continue;
            }
            const double share = (views.shiftAtInfinity - views.parallaxScale / z) / views.left.width;
            seen.nearest = any ? std::min(seen.nearest, z) : z;
            seen.farthest = any ? std::max(seen.farthest, z) : z;
            seen.range.near = any ? std::min(seen.range.near, share) : share;
            seen.range.far = any ? std::max(seen.range.far, share) : share;
            any = true;
            int bin = -1;
            while (bin < ParallaxHistogram::kBins && share >= ParallaxHistogram::lowerEdge(bin + 1)) ++bin;
            if (bin < 0)
                ++seen.histogram.below;
            else if (bin == ParallaxHistogram::kBins)
                ++seen.histogram.above;
            else
                ++seen.histogram.counts[static_cast<std::size_t>(bin)];
        }
    return seen;
}

void expectSame(const ParallaxSeen& seen, const ParallaxSeen& plain, const std::string& what) {
    EXPECT_EQ(seen.nearest, plain.nearest) << what;
    EXPECT_EQ(seen.farthest, plain.farthest) << what;
    EXPECT_EQ(seen.range.near, plain.range.near) << what;
    EXPECT_EQ(seen.range.far, plain.range.far) << what;
    EXPECT_EQ(seen.histogram.counts, plain.histogram.counts) << what;
    EXPECT_EQ(seen.histogram.below, plain.histogram.below) << what;
    EXPECT_EQ(seen.histogram.above, plain.histogram.above) << what;
    EXPECT_EQ(seen.histogram.unknown, plain.histogram.unknown) << what;
}

void expectAsPlain(const StereoViews& views, const Plane<float>& depth, const std::string& what) {
    const ParallaxSeen plain = plainlySeen(views, depth);
    for (const SimdTarget target : simdTargets())
        expectSame(parallaxSeen(views, depth, target), plain, what + ", " + std::string(nameOf(target)));
}

template <typename Depth>
Plane<float> planeOf(int width, int height, const Depth& depth) {
    Plane<float> plane(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < plane.stride(); ++x)  // what is behind a row's end is not to be read as a pixel
            plane.row(y)[x] = x < width ? depth(x, y) : 1e-3f;
    return plane;
}

constexpr StereoSetting kEyes{2.0, 60.0};  // 2.2 % at infinity

TEST(ParallaxHistogram, SmoothAndNoisyPicturesOfAnySize) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> logs(-3.0f, 12.0f);
    for (int width = 1; width <= 70; width += width < 40 ? 1 : 7) {
        const int height = 1 + width % 67;
        const StereoViews views = viewsOf(width, height, kEyes);
        expectAsPlain(views, planeOf(width, height, [&](int, int) { return std::exp(logs(random)); }),
                      "noise, width " + std::to_string(width));
        expectAsPlain(views,
                      planeOf(width, height, [&](int x, int y) { return 20.0f + 3.0f * y + 0.1f * x; }),
                      "slope, width " + std::to_string(width));
    }
}

// Depths at the edges of bins, and the floats beside them, where a parallax in float would be off.
TEST(ParallaxHistogram, DepthsAtTheEdgesOfBins) {
    const StereoViews views = viewsOf(640, 480, kEyes);
    std::vector<float> depths;
    for (int n = 0; n <= ParallaxHistogram::kBins; ++n) {
        const double edge = ParallaxHistogram::lowerEdge(n) * views.left.width;
        const auto depth = static_cast<float>(views.parallaxScale / (views.shiftAtInfinity - edge));
        if (!(depth > 0)) continue;
        float at = depth;
        for (int k = 0; k < 8; ++k) at = std::nextafter(at, 0.0f);
        for (int k = 0; k < 17; ++k, at = std::nextafter(at, kMissDepth)) depths.push_back(at);
    }
    const int count = static_cast<int>(depths.size());
    ASSERT_GT(count, 500);
    expectAsPlain(views, planeOf(count, 2, [&](int x, int) { return depths[static_cast<std::size_t>(x)]; }),
                  "edges");
}

TEST(ParallaxHistogram, OneThinNearThingCounts) {
    const StereoViews views = viewsOf(1280, 720, kEyes);
    Plane<float> depth = planeOf(1280, 720, [](int, int) { return 100.0f; });
    depth.at(641, 333) = 17.0f;  // not in every fourth pixel of every fourth row
    const ParallaxSeen seen = parallaxSeen(views, depth);
    EXPECT_EQ(seen.nearest, 17.0);
    EXPECT_EQ(seen.range.near, parallaxAt(views, 17.0));
    EXPECT_EQ(seen.histogram.known(), 1280 * 720);
    expectAsPlain(views, depth, "thin");
}

TEST(ParallaxHistogram, SkyAlone) {
    const StereoViews views = viewsOf(33, 17, kEyes);
    const Plane<float> sky = planeOf(33, 17, [](int, int) { return kMissDepth; });
    expectAsPlain(views, sky, "sky");
    const ParallaxSeen seen = parallaxSeen(views, sky);
    const double infinity = views.shiftAtInfinity / 33;
    EXPECT_EQ(seen.range.near, infinity);
    EXPECT_EQ(seen.range.far, infinity);
    const int bin = static_cast<int>((infinity - ParallaxHistogram::kLowest) /
                                     (ParallaxHistogram::kHighest - ParallaxHistogram::kLowest) * 64);
    EXPECT_EQ(seen.histogram.share(bin), 1.0);
}

TEST(ParallaxHistogram, WhatIsNoDepthIsLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                tiny = std::numeric_limits<float>::denorm_min();
    const std::vector<float> values{nan,   -nan,        0.0f,  -0.0f,
                                    -5.0f, -kMissDepth, 60.0f, kMissDepth,
                                    tiny,  1e-30f,      60.0f, std::numeric_limits<float>::max()};
    for (int width : {1, 5, 12, 40}) {
        const Plane<float> depth = planeOf(width, 3, [&](int x, int y) {
            return values[static_cast<std::size_t>(x + 5 * y) % values.size()];
        });
        expectAsPlain(viewsOf(width, 3, kEyes), depth, "mixed " + std::to_string(width));
    }
    const ParallaxSeen none =
        parallaxSeen(viewsOf(9, 9, kEyes), planeOf(9, 9, [&](int, int) { return nan; }));
    EXPECT_EQ(none.histogram.unknown, 81);
    EXPECT_EQ(none.histogram.known(), 0);
    EXPECT_EQ(none.histogram.share(30), 0.0);
    EXPECT_EQ(none.range.near, 0.0);
    EXPECT_EQ(none.range.far, 0.0);
    EXPECT_EQ(parallaxSeen(viewsOf(9, 9, kEyes), {}).histogram.known(), 0) << "no picture";
}

TEST(ParallaxHistogram, EyesInOnePlaceSeeNoParallax) {
    const StereoViews views = viewsOf(50, 20, {0.0, 60.0});
    const Plane<float> depth =
        planeOf(50, 20, [](int x, int) { return x == 0 ? kMissDepth : 0.01f * static_cast<float>(x); });
    expectAsPlain(views, depth, "one place");
    EXPECT_EQ(parallaxSeen(views, depth).range.near, 0.0);
}

TEST(ParallaxHistogram, EyesFarApartLeaveTheBins) {
    const StereoViews views = viewsOf(64, 64, {30.0, 60.0});
    const Plane<float> depth = planeOf(64, 64, [](int x, int y) {
        return (x + y) % 3 == 0 ? kMissDepth : 10.0f + static_cast<float>(x * y);
    });
    expectAsPlain(views, depth, "far apart");
    const ParallaxHistogram histogram = parallaxSeen(views, depth).histogram;
    EXPECT_GT(histogram.below, 0);
    EXPECT_GT(histogram.above, 0);
    double shares = histogram.shareOf(histogram.below) + histogram.shareOf(histogram.above);
    for (int n = 0; n < ParallaxHistogram::kBins; ++n) shares += histogram.share(n);
    EXPECT_NEAR(shares, 1.0, 1e-12);
}

// Beyond what float can count in: no class is right at the first try.
TEST(ParallaxHistogram, EyesWithoutMeasure) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> logs(-60.0f, 60.0f);
    const Plane<float> depth = planeOf(61, 9, [&](int, int) { return std::exp(logs(random)); });
    for (const StereoSetting& eyes :
         {StereoSetting{1e9, 1e-9}, StereoSetting{1e300, 1e-3}, StereoSetting{1e6, 30.0},
          StereoSetting{1e-300, 1e9}, StereoSetting{1e9, 1e9}})
        expectAsPlain(viewsOf(61, 9, eyes), depth, std::to_string(eyes.separation));
}

TEST(ParallaxHistogram, IsTheSameForAnyNumberOfThreads) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> depths(5.0f, 500.0f);
    const StereoViews views = viewsOf(301, 203, kEyes);
    const Plane<float> depth = planeOf(301, 203, [&](int, int) { return depths(random); });
    const int before = threadCount();
    setThreadCount(1);
    const ParallaxSeen one = parallaxSeen(views, depth);
    setThreadCount(5);
    expectSame(parallaxSeen(views, depth), one, "five threads");
    setThreadCount(before);
}

}  // namespace
}  // namespace stereonav
