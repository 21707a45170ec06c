// Rays at edges: which pixels get them, by a plain search on pictures of every kind; what they become, by
// rays cast one by one; and that both eyes come nearer to many rays a pixel.
#include "engine/sampling/edge_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/frame/cast_frames.h"
#include "engine/sampling/edge_row.h"
#include "engine/sampling/pixel_samples.h"
#include "tests/support/analytic_scene.h"

namespace stereonav {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

int largestDifference(PackedColor a, PackedColor b) {
    int most = 0;
    for (int shift = 0; shift < 30; shift += 10)
        most = std::max(
            most, std::abs(static_cast<int>(a >> shift & 1023u) - static_cast<int>(b >> shift & 1023u)));
    return most;
}

// Finds edges like edge_row.h, one pixel at a time.
bool plainEdge(const EyeImage& image, const EdgeSetting& setting, int x, int y) {
    const auto depth = [&](int i, int j) {
        const bool inside = i >= 0 && j >= 0 && i < image.width() && j < image.height();
        return inside ? image.viewDepth.at(i, j) : 0.0f;
    };
    if (!(depth(x, y) > 0)) return false;
    int difference = 0;
    bool broken = false, jumps = false;
    for (const auto& [i, j] : {std::pair{1, 0}, {0, 1}}) {
        for (const int side : {-1, 1})
            if (depth(x + side * i, y + side * j) > 0)
                difference = std::max(
                    difference,
                    largestDifference(image.color.at(x, y), image.color.at(x + side * i, y + side * j)));
        const float before = depth(x - i, y - j), after = depth(x + i, y + j);
        if (!(before > 0 && after > 0)) continue;
        const float b = 1 / before, at = 1 / depth(x, y), a = 1 / after;
        const auto bentBeyond = [&](double share) {
            return std::abs((b + a) - (at + at)) > static_cast<float>(share) * std::max({b, at, a});
        };
        broken = broken || bentBeyond(setting.depthBreak);
        jumps = jumps || bentBeyond(setting.depthJump);
    }
    return (broken && difference >= setting.contrast) || (jumps && difference >= setting.jumpContrast) ||
           difference >= setting.strongContrast;
}

// Surfaces, sky, unknown pixels, depths of every size, NaN.
EyeImage anyPicture(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    EyeImage image;
    image.resize(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float kind = unit(random);
            const float plane = 1 / (0.01f + 0.001f * static_cast<float>(x) + 0.002f * static_cast<float>(y));
            image.viewDepth.at(x, y) = kind < 0.7f    ? plane
                                       : kind < 0.8f  ? kInfinity
                                       : kind < 0.9f  ? plane * (1 + 0.01f * unit(random))
                                       : kind < 0.93f ? 0.0f
                                       : kind < 0.94f ? std::numeric_limits<float>::quiet_NaN()
                                                      : std::pow(10.0f, 60 * unit(random) - 30);
            image.color.at(x, y) = packColor(glm::vec3(0.3f + 0.15f * unit(random) * unit(random)));
        }
    return image;
}

TEST(EdgeRays, FindWhatAPlainSearchFinds) {
    EdgeSetting setting;
    setting.contrast = 40;
    setting.jumpContrast = 20;
    setting.strongContrast = 90;
    for (const auto& [width, height] :
         {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {3, 3}, {15, 4}, {16, 5}, {17, 6}, {18, 33}, {131, 47}}) {
        const EyeImage image = anyPicture(width, height, static_cast<unsigned>(width));
        for (const SimdTarget target : simdTargets()) {
            const EdgeFunction find = edgeFinder(target);
            long long found = 0;
            Plane<std::uint8_t> edges(width, height);
            const auto row = [height = height](const auto& plane, int y) {
                return y < 0 || y >= height ? nullptr : plane.row(y);
            };
            for (int y = 0; y < height; ++y) {
                find({row(image.color, y - 1), image.color.row(y), row(image.color, y + 1),
                      row(image.viewDepth, y - 1), image.viewDepth.row(y), row(image.viewDepth, y + 1),
                      edges.row(y), width, setting.contrast, setting.jumpContrast, setting.strongContrast,
                      static_cast<float>(setting.depthBreak), static_cast<float>(setting.depthJump)});
                for (int x = 0; x < width; ++x) {
                    ASSERT_EQ(edges.at(x, y) != 0, plainEdge(image, setting, x, y))
                        << x << ' ' << y << ' ' << width;
                    found += edges.at(x, y) != 0;
                }
            }
            if (width == 131) {
                EXPECT_GT(found, 200);
                EXPECT_LT(found, 131 * 47 * 2 / 3);
            }
        }
    }
}

TEST(EdgeRays, APlaneHasNoEdgeHoweverItIsSeen) {
    EyeImage image;
    image.resize(64, 48);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            image.viewDepth.at(x, y) =
                1 / (1e-4f + 1e-3f * static_cast<float>(y) + 2e-5f * static_cast<float>(x));
            image.color.at(x, y) = packColor(glm::vec3((x + y) % 2 ? 0.2f : 0.3f));  // its own
        }
    EdgeSetting setting;
    Plane<std::uint8_t> edges;
    findEdges(image, setting, edges);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) ASSERT_EQ(edges.at(x, y), 0);
    image.viewDepth.at(20, 20) *= 1.01f;
    findEdges(image, setting, edges);
    EXPECT_EQ(edges.at(20, 20), 255);
}

StereoViews views(int width = 90, int height = 60) {
    Lens lens;
    lens.width = width;
    lens.height = height;
    return makeStereoViews(poseFromAngles({0, 0, 0}, 0, -0.1, 0), lens, {0.3, 9.0});
}

test::AnalyticScene shapes(bool glossy = false, double waves = 0.5) {
    return test::AnalyticScene({test::sphere({-1.5, 10, -1}, 1.7), test::box({1, 9, -4}, {2.2, 11, 1}),
                                test::plane({0, 0, -4}, {0.1, 0, 1})},
                               waves, glossy);
}

TEST(EdgeRays, ColoursAreTheMeanOfTheRays) {
    for (const bool glossy : {false, true}) {
        const test::AnalyticScene scene = shapes(glossy);
        const EyeView view = views().left;
        EyeImage plain, smooth;
        plain.resize(view.width, view.height, scene.viewDependence());
        renderEye(scene, view, plain);
        smooth = plain;
        EdgeSetting setting;
        setting.rays = 4;
        EdgeRays rays;
        const EdgeTimings timings = rays.smooth(scene, view, setting, smooth);
        std::vector<EyeImage> casts;
        for (const glm::dvec2& place : rotatedGrid(4)) {
            casts.emplace_back();
            casts.back().resize(view.width, view.height, scene.viewDependence());
            renderEye(scene, shiftedBy(view, place), casts.back());
        }
        long long pixels = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                ASSERT_EQ(smooth.viewDepth.at(x, y), plain.viewDepth.at(x, y));
                PackedColor expected = plain.color.at(x, y);
                if (rays.edges().at(x, y)) {
                    ++pixels;
                    glm::vec3 sum = unpackColor(expected);
                    for (const EyeImage& cast : casts) sum += unpackColor(cast.color.at(x, y));
                    expected = packColor(sum * (1.0f / 5.0f));
                }
                ASSERT_EQ(smooth.color.at(x, y), expected) << x << ' ' << y;
            }
        EXPECT_EQ(timings.pixels, pixels);
        EXPECT_GT(pixels, 100);
        EXPECT_LT(pixels, 90 * 60 / 4);
    }
}

double meanSquare(const Plane<PackedColor>& a, const Plane<PackedColor>& b) {
    double sum = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const glm::vec3 d = unpackColor(a.at(x, y)) - unpackColor(b.at(x, y));
            sum += static_cast<double>(glm::dot(d, d));
        }
    return sum / (a.width() * a.height());
}

Plane<PackedColor> manyRays(const EyeRenderer& scene, const EyeView& view) {
    constexpr int kFactor = 8;
    EyeImage fine;
    fine.resize(view.width * kFactor, view.height * kFactor, scene.viewDependence());
    renderEye(scene, view.supersampled(kFactor), fine);
    Plane<PackedColor> mean(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            glm::vec3 sum(0);
            for (int k = 0; k < kFactor * kFactor; ++k)
                sum += unpackColor(fine.color.at(x * kFactor + k % kFactor, y * kFactor + k / kFactor));
            mean.at(x, y) = packColor(sum / static_cast<float>(kFactor * kFactor));
        }
    return mean;
}

// By every method that fills its holes, and whatever the threads.
TEST(EdgeRays, BringBothEyesNearerToManyRays) {
    const test::AnalyticScene scene = shapes();
    CastFrames frames(scene);
    const StereoViews both = views();
    const Plane<PackedColor> left = manyRays(scene, both.left), right = manyRays(scene, both.right);
    const int threads = threadCount();
    for (const std::string_view method : {"full", "linear", "cubic", "paper"}) {
        SCOPED_TRACE(method);
        EyePair plain, smooth, onOneThread;
        frames.make(both, 0, {method}, plain);
        FrameWay way{method};
        way.edges.rays = 4;
        frames.make(both, 0, way, smooth);
        EXPECT_LT(meanSquare(smooth.left.color, left), 0.3 * meanSquare(plain.left.color, left));
        EXPECT_LT(meanSquare(smooth.right.color, right), 0.5 * meanSquare(plain.right.color, right));
        EXPECT_GT(smooth.timings.edges.pixels, 0);
        EXPECT_EQ(plain.timings.edges.pixels, 0);
        setThreadCount(1);
        frames.make(both, 0, way, onOneThread);
        setThreadCount(threads);
        EXPECT_EQ(meanSquare(smooth.left.color, onOneThread.left.color), 0);
        EXPECT_EQ(meanSquare(smooth.right.color, onOneThread.right.color), 0);
    }
}

// What lies on both sides of an edge is mixed in both eyes, but never moved as one surface: beside the near
// thing the right eye shows nothing of its colour that a full cast does not show.
TEST(EdgeRays, LeaveNoHaloBesideTheWarp) {
    const test::AnalyticScene scene =
        shapes(false, 0.02);  // colours that hardly change but from shape to shape
    CastFrames frames(scene);
    FrameWay warp{"linear"}, full{"full"};
    warp.edges.rays = full.edges.rays = 8;
    EyePair warped, cast;
    frames.make(views(), 0, warp, warped);
    frames.make(views(), 0, full, cast);
    int most = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 90; ++x)
            most = std::max(most, largestDifference(warped.right.color.at(x, y), cast.right.color.at(x, y)));
    EXPECT_LT(most, 60) << "of 1023";
}

TEST(EdgeRays, LeaveHolesAlone) {
    const test::AnalyticScene scene = shapes();
    CastFrames frames(scene);
    FrameWay way{"nofill"};
    way.edges.rays = 4;
    EyePair plain, smooth;
    frames.make(views(), 0, {"nofill"}, plain);
    frames.make(views(), 0, way, smooth);
    EXPECT_EQ(meanSquare(plain.right.color, smooth.right.color), 0);
    EXPECT_GT(meanSquare(plain.left.color, smooth.left.color), 0);
}

TEST(EdgeRays, RefuseTooMany) {
    EyeImage image;
    image.resize(4, 4);
    EdgeRays rays;
    EdgeSetting setting;
    for (const int count : {-1, kMostEdgeRays + 1}) {
        setting.rays = count;
        EXPECT_THROW(rays.smooth(shapes(), views(4, 4).left, setting, image), Error);
    }
}

TEST(PixelSamples, TheRotatedGridIsEvenAndSymmetric) {
    for (int count = 1; count <= kMostEdgeRays; ++count) {
        const auto places = rotatedGrid(count);
        ASSERT_EQ(places.size(), static_cast<std::size_t>(count));
        std::vector<int> rows(static_cast<std::size_t>(count)), columns(rows);
        glm::dvec2 mean(0);
        for (const glm::dvec2& p : places) {
            ASSERT_LT(std::max(std::abs(p.x), std::abs(p.y)), 0.5);
            ++columns[static_cast<std::size_t>((p.x + 0.5) * count)];
            ++rows[static_cast<std::size_t>((p.y + 0.5) * count)];
            mean += p;
        }
        for (const int n : columns) EXPECT_EQ(n, 1);
        for (const int n : rows) EXPECT_EQ(n, 1);
        EXPECT_NEAR(glm::length(mean), 0, 1e-12);
    }
    // The rotated grid of graphics processors, one way round or the other.
    const auto four = rotatedGrid(4);
    EXPECT_NEAR(std::abs(four[0].y), 0.125, 1e-12);
    EXPECT_NEAR(std::abs(four[1].y), 0.375, 1e-12);
    EXPECT_THROW(rotatedGrid(0), Error);
    EXPECT_THROW(rotatedGrid(65), Error);
}

TEST(PixelSamples, EvenPlacesFillThePixelFromTheBeginning) {
    EXPECT_EQ(evenPlace(0), glm::dvec2(0));
    for (const int count : {16, 64, 256}) {
        const int cells = static_cast<int>(std::sqrt(count)) / 2;  // four places each, if they are even
        std::vector<int> in(static_cast<std::size_t>(cells) * cells);
        for (int k = 0; k < count; ++k) {
            const glm::dvec2 p = evenPlace(k) + 0.5;
            ++in[static_cast<std::size_t>(p.y * cells) * cells + static_cast<std::size_t>(p.x * cells)];
        }
        for (const int n : in) {
            EXPECT_GE(n, 2);
            EXPECT_LE(n, 7);
        }
    }
    const glm::dvec2 far = evenPlace(1LL << 40);
    EXPECT_LT(std::max(std::abs(far.x), std::abs(far.y)), 0.5 + 1e-9);
}

TEST(PixelSamples, AShiftedViewSeesThroughThePlaces) {
    const StereoViews both = views();
    const glm::dvec2 place(0.3, -0.2);
    const StereoViews shifted = shiftedBy(both, place);
    for (const auto& [a, b] : {std::pair{both.left, shifted.left}, {both.right, shifted.right}}) {
        const glm::dvec3 apart = b.rayDirection(7.5, 9.5) - a.rayDirection(7.5 + place.x, 9.5 + place.y);
        EXPECT_LT(glm::length(apart), 1e-14);
    }
    EXPECT_EQ(shifted.parallaxScale, both.parallaxScale);
}

}  // namespace
}  // namespace stereonav
