// Figures of ground whose samples lie in tiles are those of the same ground in memory, to the last bit.
#include "terrain/survey/ground_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/math/earth_bend.h"
#include "terrain/ground/height_pyramid.h"
#include "terrain/survey/ground_area.h"
#include "terrain/survey/ground_line.h"
#include "terrain/survey/sight_line.h"

namespace stereonav {
namespace {

using Places = std::vector<glm::dvec2>;

// 800 x 600 samples, 4 x 3 tiles of which the last are cut, with a hole.
class SamplesInTiles : public testing::Test {
protected:
    SamplesInTiles() {
        std::vector<float> heights;
        for (int j = 0; j < 600; ++j)
            for (int i = 0; i < 800; ++i)
                heights.push_back(std::hypot(i - 650, j - 90) < 20 ? std::nanf("") : heightOf(i, j));
        mGround = Heightfield(800, 600, {2.5, 3}, std::move(heights), "test");
        StoredLevels stored;
        stored.size = {800, 600};
        stored.spacing = mGround.spacing();
        stored.low = mGround.minHeight(), stored.high = mGround.maxHeight();
        stored.bounds = {std::vector<float>(13 * 10, 0.0f)};
        stored.read = [this](int, const glm::ivec2& low, const glm::ivec2& size, float* to) {
            const std::lock_guard lock(mMutex);
            ++mReads[{low.x, low.y}];
            for (int j = 0; j < size.y; ++j)
                std::memcpy(to + static_cast<std::ptrdiff_t>(j) * size.x,
                            mGround.data() + static_cast<std::ptrdiff_t>(low.y + j) * 800 + low.x,
                            sizeof(float) * size.x);
        };
        mLevels = std::make_shared<GroundLevels>(std::move(stored));
    }
    ~SamplesInTiles() override { setThreadCount(2); }

    static float heightOf(int i, int j) {
        return static_cast<float>(300 + 90 * std::sin(i / 37.) * std::cos(j / 29.) +
                                  7 * std::sin(i * 1.3 + j) + 5 * std::cos(j * 0.7));
    }
    GroundSamples inTiles(std::size_t bytes = SurveyTiles::kMostBytes) {
        mReads.clear();
        return GroundSamples(std::make_shared<SurveyTiles>(mLevels, 0, bytes));
    }
    int mostReads() const {
        int most = 0;
        for (const auto& [tile, count] : mReads) most = std::max(most, count);
        return most;
    }

    Heightfield mGround;
    std::shared_ptr<const GroundLevels> mLevels;
    std::mutex mMutex;
    std::map<std::pair<int, int>, int> mReads;
};

void expectSame(const LineMeasure& a, const LineMeasure& b) {
    for (const auto figure :
         {&LineMeasure::plan, &LineMeasure::straight, &LineMeasure::along, &LineMeasure::rise,
          &LineMeasure::climb, &LineMeasure::descent, &LineMeasure::lowest, &LineMeasure::highest})
        EXPECT_EQ(std::memcmp(&(a.*figure), &(b.*figure), sizeof(double)), 0)
            << a.*figure << " " << b.*figure;
}

void expectSame(const AreaMeasure& a, const AreaMeasure& b) {
    for (const auto figure :
         {&AreaMeasure::plan, &AreaMeasure::along, &AreaMeasure::perimeter, &AreaMeasure::above,
          &AreaMeasure::below, &AreaMeasure::highest, &AreaMeasure::lowest})
        EXPECT_EQ(std::memcmp(&(a.*figure), &(b.*figure), sizeof(double)), 0)
            << a.*figure << " " << b.*figure;
}

TEST_F(SamplesInTiles, LinesAreThoseInMemoryAndReadEachTileOnce) {
    const Places across{{-870.1, -890.2}, {100.3, 400.7}, {860, 880}, {-800, 870}};
    const Places throughHole{{500, -890}, {740.5, -500}};
    for (const Places& line : {across, throughHole}) {
        const GroundSamples tiled = inTiles();
        expectSame(measureLine(tiled, line), measureLine(mGround, line));
        expectSame(errorsOfLine(tiled, line, measureLine(tiled, line)),
                   errorsOfLine(mGround, line, measureLine(mGround, line)));
        const auto points = groundLine(tiled, line), known = groundLine(mGround, line);
        ASSERT_EQ(points.size(), known.size());
        for (std::size_t n = 0; n < points.size(); ++n) {
            ASSERT_EQ(std::memcmp(&points[n].height, &known[n].height, sizeof(double)), 0);
            ASSERT_EQ(points[n].along, known[n].along);
            ASSERT_EQ(points[n].world, known[n].world);
        }
        EXPECT_EQ(mostReads(), 1);
        EXPECT_LT(mReads.size(), 12U) << "tiles that the line does not touch";
    }
    // Room for one tile alone: read again and again, and the same.
    const GroundSamples poor = inTiles(1);
    expectSame(errorsOfLine(poor, across, measureLine(poor, across)),
               errorsOfLine(mGround, across, measureLine(mGround, across)));
    EXPECT_GT(mostReads(), 1);
}

TEST_F(SamplesInTiles, AreasAreThoseInMemoryWhateverTheThreads) {
    const Places dented{{-330, -300}, {100, -230}, {10, 0}, {320, 301.5}, {-260, 301.5}, {-110, 0}};
    const Places overHole{{560, -700}, {660, -700}, {660, -560}};
    for (const Places& area : {dented, overHole}) {
        const AreaMeasure known = measureArea(mGround, area, 310),
                          errors = errorsOfArea(mGround, area, 310, known);
        for (const int threads : {1, 3}) {
            setThreadCount(threads);
            const GroundSamples tiled = inTiles();
            expectSame(measureArea(tiled, area, 310), known);
            expectSame(errorsOfArea(tiled, area, 310, measureArea(tiled, area, 310)), errors);
        }
        const double lowest = lowestInArea(inTiles(), area);
        EXPECT_EQ(std::memcmp(&lowest, &known.lowest, sizeof lowest), 0);
        EXPECT_EQ(std::isnan(known.above), area.size() == 3) << "over the hole alone";
    }
}

// A square that is gone around twice, and an eight whose halves take each other away.
TEST_F(SamplesInTiles, WhatABorderGoesAroundTwiceCountsTwice) {
    const Places once{{-300.3, -200}, {-100, -200}, {-100, 50.7}, {-300.3, 50.7}};
    Places twice = once;
    twice.insert(twice.end(), once.begin(), once.end());
    const AreaMeasure one = measureArea(mGround, once, 300), two = measureArea(mGround, twice, 300);
    EXPECT_NEAR(two.plan, 2 * one.plan, 1e-6);
    EXPECT_NEAR(two.along, 2 * one.along, 1e-6);
    EXPECT_NEAR(two.above, 2 * one.above, 1e-5);
    EXPECT_NEAR(two.below, 2 * one.below, 1e-5);
    const Places eight{{-300, -200}, {-100, -200}, {-300, 100}, {-100, 100}};
    EXPECT_NEAR(measureArea(mGround, eight, 0).plan, 0, 1e-6);
}

// Against the walk over blocks of maxima.
TEST_F(SamplesInTiles, SightsAreThoseOfTheWalkOverMaxima) {
    const HeightPyramid maxima(mGround);
    const GroundSamples tiled = inTiles();
    int hidden = 0;
    for (const double fall : {0.0, curvatureFall(0.13)})
        for (int n = 0; n < 40; ++n) {
            const glm::dvec2 from(10 + 13.7 * n, 580 - 9.3 * n),
                to(690 - 16.1 * n, 5 + 14.9 * ((7 * n) % 40));
            const auto over = [&](const glm::dvec2& at, double height) {
                const double ground = mGround.heightAt(mGround.worldFromGrid(at));
                EXPECT_EQ(tiled.heightAt(tiled.worldFromGrid(at)), ground);
                return glm::dvec3(at, ground + height);
            };
            const glm::dvec3 eye = over(from, 40), target = over(to, 3);
            const Sight known = SightLines(mGround, maxima, fall).measure(eye, target),
                        sight = sightOver(tiled, fall, eye, target);
            EXPECT_EQ(sight.seen, known.seen) << n;
            EXPECT_EQ(sight.clearance, known.clearance) << n;
            EXPECT_EQ(sight.at, known.at) << n;
            hidden += !sight.seen;
        }
    EXPECT_GT(hidden, 10);
    EXPECT_LT(hidden, 78);
}

}  // namespace
}  // namespace stereonav
