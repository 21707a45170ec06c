// Holes in the heights, filled: planes exactly, borders kept, ranges kept.
#include "terrain/ground/nodata.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

struct Grid {
    int width, height;
    std::vector<float> heights;
    float& at(int i, int j) { return heights[static_cast<std::size_t>(j) * width + i]; }
};

template <typename Function>
Grid makeGrid(int width, int height, const Function& f) {
    Grid grid{width, height, std::vector<float>(static_cast<std::size_t>(width) * height)};
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) grid.at(i, j) = static_cast<float>(f(i, j));
    return grid;
}

long long fill(Grid& grid, glm::dvec2 spacing = glm::dvec2(30)) {
    Progress progress;
    return fillMissing(grid.heights, grid.width, grid.height, spacing, progress);
}

TEST(Nodata, PlaneWithAHoleComesBack) {
    const auto plane = [](double i, double j) { return 500 + 3 * i - 2 * j; };
    Grid grid = makeGrid(120, 90, plane);
    long long holes = 0;
    for (int j = 0; j < 90; ++j)
        for (int i = 0; i < 120; ++i)
            if (std::hypot(i - 60, j - 40) < 33) {
                grid.at(i, j) = NAN;
                ++holes;
            }
    EXPECT_EQ(countMissing(grid.heights), holes);
    EXPECT_EQ(fill(grid), holes);
    EXPECT_EQ(countMissing(grid.heights), 0);
    // A linear function is harmonic on any grid: 198 m across the hole, back to a millimetre.
    for (int j = 0; j < 90; ++j)
        for (int i = 0; i < 120; ++i) EXPECT_NEAR(grid.at(i, j), plane(i, j), 1e-3) << i << " " << j;
}

// The solver's number of rounds does not grow with the hole: 70,000 samples in one, 200 alone.
TEST(Nodata, LargeAndScatteredHolesInOnePlane) {
    const auto plane = [](double i, double j) { return 500 + 0.3 * i - 0.2 * j; };
    Grid grid = makeGrid(401, 402, plane);
    for (int j = 0; j < 402; ++j)
        for (int i = 0; i < 401; ++i)
            if (std::hypot(i - 200, j - 201) < 150 || (i % 29 == 3 && j % 31 == 5)) grid.at(i, j) = NAN;
    int rounds = 0;
    Progress progress([&](double, const std::string&) { ++rounds; });
    fillMissing(grid.heights, grid.width, grid.height, {64, 93}, progress);
    EXPECT_LT(rounds, 40);
    for (int j = 0; j < 402; ++j)
        for (int i = 0; i < 401; ++i) EXPECT_NEAR(grid.at(i, j), plane(i, j), 5e-4) << i << " " << j;
}

TEST(Nodata, AnisotropicSpacingFollowsTheMembrane) {
    // x^2 - y^2 in metres is harmonic; on the grid's five-point Laplacian exactly so.
    const glm::dvec2 spacing(64, 93);
    const auto saddle = [&](double i, double j) {
        const double x = (i - 30) * spacing.x, y = (j - 30) * spacing.y;
        return 1e-3 * (x * x - y * y);
    };
    Grid grid = makeGrid(61, 61, saddle);
    for (int j = 15; j < 45; ++j)
        for (int i = 12; i < 50; ++i) grid.at(i, j) = NAN;
    fill(grid, spacing);
    for (int j = 0; j < 61; ++j)
        for (int i = 0; i < 61; ++i) EXPECT_NEAR(grid.at(i, j), saddle(i, j), 0.003) << i << " " << j;
}

TEST(Nodata, GapsAtTheBorderStayInRange) {
    Grid grid =
        makeGrid(70, 50, [](int i, int j) { return 100 + 50 * std::sin(0.3 * i) + 40 * std::cos(0.4 * j); });
    for (int j = 0; j < 50; ++j)
        for (int i = 0; i < 70; ++i)
            if (i < j / 2 || i + j > 100) grid.at(i, j) = NAN;
    const Grid before = grid;
    float low = INFINITY, high = -INFINITY;
    for (const float h : grid.heights)
        if (!std::isnan(h)) low = std::min(low, h), high = std::max(high, h);
    fill(grid);
    for (std::size_t k = 0; k < grid.heights.size(); ++k) {
        if (!std::isnan(before.heights[k])) {
            EXPECT_EQ(grid.heights[k], before.heights[k]);
        }
        EXPECT_GE(grid.heights[k], low - 0.01f);
        EXPECT_LE(grid.heights[k], high + 0.01f);
    }
}

TEST(Nodata, OneKnownSampleFillsEverything) {
    Grid grid = makeGrid(17, 13, [](int, int) { return NAN; });
    grid.at(4, 11) = 321;
    EXPECT_EQ(fill(grid), 17 * 13 - 1);
    for (const float h : grid.heights) EXPECT_NEAR(h, 321, 1e-3);
}

TEST(Nodata, NothingKnownOrNothingMissingIsLeftAlone) {
    Grid all = makeGrid(5, 4, [](int, int) { return NAN; });
    EXPECT_EQ(fill(all), 0);
    EXPECT_EQ(countMissing(all.heights), 20);
    Grid none = makeGrid(5, 4, [](int i, int j) { return i * j; });
    const auto before = none.heights;
    EXPECT_EQ(fill(none), 0);
    EXPECT_EQ(none.heights, before);
}

TEST(Nodata, CancelStopsIt) {
    Grid grid = makeGrid(40, 40, [](int i, int j) { return i * i + j; });
    for (int k = 10; k < 30; ++k) grid.at(k, k) = NAN;
    Progress progress;
    progress.cancel();
    EXPECT_THROW(fillMissing(grid.heights, 40, 40, glm::dvec2(1), progress), Cancelled);
}

}  // namespace
}  // namespace stereonav
