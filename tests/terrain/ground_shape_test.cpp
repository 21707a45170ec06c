// How ground lies: hollows and wetness against the topographic index, and ground of every kind.
#include "terrain/scene/ground_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "engine/base/parallel.h"
#include "terrain/built_in/built_in_terrain.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

// Returns ln(a / tan b) at samples (Beven and Kirkby 1979): a, the area that drains through a sample, is
// shared among lower neighbours by their slope (Quinn et al. 1991).
std::vector<double> topographicIndex(const Heightfield& ground) {
    const int w = ground.width(), h = ground.height();
    std::vector<int> order(static_cast<std::size_t>(w) * h);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, [&](int a, int b) { return ground.data()[a] > ground.data()[b]; });
    const double side = ground.spacing().x;
    std::vector<double> area(order.size(), side), index(order.size());
    for (const int k : order) {
        const int i = k % w, j = k / w;
        double slopes[3][3] = {}, sum = 0;
        for (int dj = -1; dj <= 1; ++dj)
            for (int di = -1; di <= 1; ++di) {
                if (i + di < 0 || j + dj < 0 || i + di >= w || j + dj >= h) continue;
                const double fall = ground.sample(i, j) - ground.sample(i + di, j + dj);
                if (!(fall > 0)) continue;
                slopes[dj + 1][di + 1] = fall / (side * std::hypot(di, dj));
                sum += slopes[dj + 1][di + 1];
            }
        for (int dj = -1; dj <= 1; ++dj)
            for (int di = -1; di <= 1; ++di)
                if (const double slope = slopes[dj + 1][di + 1]; slope > 0)
                    area[static_cast<std::size_t>(k) + dj * w + di] += area[k] * slope / sum;
        index[k] = std::log(area[k] / std::max(1e-3, glm::length(ground.gradientAtSample(i, j))));
    }
    return index;
}

std::vector<double> ranksOf(const std::vector<double>& values) {
    std::vector<int> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, [&](int a, int b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t k = 0; k < order.size(); ++k) ranks[order[k]] = static_cast<double>(k);
    return ranks;
}

// Spearman's: that of the ranks.
double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b) {
    const std::vector<double> x = ranksOf(a), y = ranksOf(b);
    const double mean = 0.5 * static_cast<double>(x.size() - 1);
    double xy = 0, xx = 0, yy = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        xy += (x[k] - mean) * (y[k] - mean);
        xx += (x[k] - mean) * (x[k] - mean);
        yy += (y[k] - mean) * (y[k] - mean);
    }
    return xy / std::sqrt(xx * yy);
}

Heightfield erodedGround(int size) {
    Progress progress;
    BuiltInTerrain built = generateBuiltInTerrain(3, size, progress);
    return Heightfield(size, size, glm::dvec2(built.spacing), std::move(built.heights), "eroded");
}

double correlationOfWetness(const Heightfield& ground) {
    const GroundShape shape(ground, ground, 1);
    std::vector<double> wet;
    for (int j = 0; j < ground.height(); ++j)
        for (int i = 0; i < ground.width(); ++i) wet.push_back(shape.siteAt({i, j}).wet);
    return rankCorrelation(wet, topographicIndex(ground));
}

TEST(GroundShape, WetnessFollowsTheTopographicIndex) {
    const double correlation = correlationOfWetness(erodedGround(257));
    RecordProperty("correlation", std::to_string(correlation));
    EXPECT_GT(correlation, 0.7);
}

TEST(GroundShape, HollowsAreBelowWhatIsAroundThemAndSlopesAreNeither) {
    std::vector<float> valley, slope;
    for (int j = 0; j < 90; ++j)
        for (int i = 0; i < 90; ++i) {
            valley.push_back(static_cast<float>(40 * std::cos(0.14 * i)));
            slope.push_back(static_cast<float>(11 * i - 4 * j));
        }
    const Heightfield folds(90, 90, glm::dvec2(30), valley, "folds"),
        plane(90, 90, glm::dvec2(30), slope, "");
    const GroundShape folded(folds, folds, 1), even(plane, plane, 1);
    EXPECT_GT(folded.siteAt({22, 40}).hollow, 0.15f);  // cos(pi)
    EXPECT_LT(folded.siteAt({45, 40}).hollow, -0.15f);
    EXPECT_GT(folded.siteAt({22, 40}).wet, folded.siteAt({45, 40}).wet + 0.2f);
    for (const double x : {0.0, 3.0, 44.0, 89.0})
        EXPECT_NEAR(even.siteAt({x, 89 - x}).hollow, 0, 0.06) << x << ", also at the border";
}

// Twice as high as it is shown: the file's heights decide.
TEST(GroundShape, ExaggerationChangesNothingButTheGradient) {
    const Heightfield ground = test::makeGround("smooth", 60, 50, 1);
    std::vector<float> doubled(ground.data(), ground.data() + 60 * 50);
    for (float& height : doubled) height *= 2;
    const Heightfield high(60, 50, ground.spacing(), doubled, "");
    const GroundShape own(ground, ground, 1), shown(high, high, 0.5);
    for (int k = 0; k < 50; ++k) {
        const GroundShape::Site a = own.siteAt({k, k}), b = shown.siteAt({k, k});
        EXPECT_NEAR(a.hollow, b.hollow, 1e-4);
        EXPECT_NEAR(a.wet, b.wet, 1e-4);
        EXPECT_EQ(a.broad, b.broad);
        EXPECT_NEAR(2 * a.gradient.x, b.gradient.x, 1e-4);
    }
}

TEST(GroundShape, EveryGroundHasAShape) {
    for (const std::string& kind : test::groundKinds())
        for (const auto& [width, height] :
             {std::pair(2, 2), std::pair(2, 70), std::pair(70, 2), std::pair(64, 47)}) {
            if (kind == "holed" && std::min(width, height) < 10) continue;
            const Heightfield ground = test::makeGround(kind, width, height, 4);
            const GroundShape shape(ground, ground, 1);
            for (double y = -1; y <= height; y += 0.5)
                for (double x = -1; x <= width; x += 0.5) {
                    const GroundShape::Site site = shape.siteAt({x, y});
                    for (const float part : {site.hollow, site.wet, site.broad}) {
                        ASSERT_TRUE(part >= -1 && part <= 1) << kind << x << " " << y << " " << part;
                    }
                }
        }
}

// A part at half the spacing says nearly what the whole says there.
TEST(GroundShape, APartIsLikeTheWhole) {
    std::vector<float> fine;
    for (int j = 0; j < 193; ++j)
        for (int i = 0; i < 193; ++i)
            fine.push_back(
                static_cast<float>(90 * std::sin(0.05 * i) * std::cos(0.04 * j) + 20 * std::sin(0.2 * i)));
    std::vector<float> coarse;
    for (int j = 0; j < 193; j += 2)
        for (int i = 0; i < 193; i += 2) coarse.push_back(fine[j * 193 + i]);
    const Heightfield part(193, 193, glm::dvec2(15), fine, "part"),
        whole(97, 97, glm::dvec2(30), coarse, "whole");
    const GroundShape of(part, whole, 1), all(whole, whole, 1);
    for (int k = 10; k < 87; k += 3) {
        EXPECT_NEAR(of.siteAt({2 * k, 2 * k}).hollow, all.siteAt({k, k}).hollow, 0.12);
        EXPECT_NEAR(of.siteAt({2 * k, 2 * k}).broad, all.siteAt({k, k}).broad, 1e-3);
    }
}

TEST(GroundShape, IsTheSameOnAnyNumberOfThreads) {
    const Heightfield ground = test::makeGround("rough", 90, 70, 2);
    const int before = threadCount();
    setThreadCount(1);
    const GroundShape one(ground, ground, 1);
    setThreadCount(4);
    const GroundShape four(ground, ground, 1);
    setThreadCount(before);
    for (int j = 0; j < 70; ++j)
        for (int i = 0; i < 90; ++i) {
            ASSERT_EQ(one.siteAt({i, j}).wet, four.siteAt({i, j}).wet);
            ASSERT_EQ(one.siteAt({i, j}).hollow, four.siteAt({i, j}).hollow);
        }
}

}  // namespace
}  // namespace stereonav
