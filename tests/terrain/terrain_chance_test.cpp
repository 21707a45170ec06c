// The numbers by chance of ground and its light: every sample, tile, seed and ray has its own. Samples of
// these grounds lie alike, so that they are alike where their numbers are.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/math/luminance.h"
#include "terrain/built_in/erosion.h"
#include "terrain/built_in/noise.h"
#include "terrain/cast/ground_detail.h"
#include "terrain/light/fine_bake.h"
#include "terrain/light/terrain_path_light.h"
#include "tests/support/chance.h"
#include "tests/support/test_grounds.h"

namespace stereonav::test {
namespace {

// Walls across the diagonal, eight samples apart, with level ground between them, which sees the light of the
// walls: samples whose column and row have the same sum, modulo 8, see the same ground.
constexpr int kPeriod = 8;
Heightfield wallsOver(int width, int height) {
    constexpr std::array<float, kPeriod> kWall{0, 0, 0, 0, 0, 0, 40, 40};
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(kWall[(i + j) % kPeriod]);
    return Heightfield(width, height, {10, 10}, std::move(heights), "walls");
}

TerrainLightSettings bouncing(std::uint64_t seed = 1, int stride = 1) {
    TerrainLightSettings settings;
    settings.order = 2;
    settings.bounces = 1;
    settings.rays = 16;
    settings.azimuths = 8;
    settings.albedo = 0.9;
    settings.stride = stride;
    settings.seed = seed;
    return settings;
}

TerrainLight bakedOver(const Heightfield& ground, const TerrainLightSettings& settings) {
    Progress quiet;
    return bakeTerrainLight(ground, settings, quiet);
}

// The light that bounces, put together from one or several bakes, with what kind of place it is of.
class BouncedLight {
public:
    BouncedLight(int width, int height) : mField(width, height), mKinds(mField.values.size()) {}

    void set(int x, int y, int kind, const TerrainLight& light, int i, int j) {
        mField.at(x, y)[0] = light.bounced[static_cast<std::size_t>(j) * light.grid.width + i];
        mKinds[static_cast<std::size_t>(y) * mField.width + x] = kind;
    }

    // Expects the values, by their ranks among places of their kind, to be uncorrelated with those at other
    // columns and rows.
    void expectUncorrelatedInKinds() const {
        ChanceField ranked(mField.width, mField.height);
        std::map<int, std::vector<std::size_t>> places;
        for (std::size_t n = 0; n < mKinds.size(); ++n) places[mKinds[n]].push_back(n);
        std::size_t byChance = 0;
        for (const auto& [kind, of] : places) {
            ChanceField samples(static_cast<int>(of.size()), 1);
            for (std::size_t n = 0; n < of.size(); ++n) samples.values[n] = mField.values[of[n]];
            // Light is in whole steps, and that of places which see little ground is much alike.
            if (spreadOfAll(samples.first()) < kLeastSpread) continue;
            byChance += of.size();
            const ChanceField ranks = byRank(samples);
            for (std::size_t n = 0; n < of.size(); ++n) ranked.values[of[n]] = ranks.values[n];
        }
        EXPECT_GT(2 * byChance, mKinds.size()) << "there is no chance in it";
        expectRanksUncorrelated(ranked);
    }

private:
    static constexpr double kLeastSpread = 50;
    ChanceField mField;
    std::vector<int> mKinds;
};

// Samples from an edge of the ground beyond which a sample sees no edge, nor do the samples that it sees.
constexpr int kSeesEdge = 16;

BouncedLight innerSamples(const TerrainLight& light) {
    const LightGrid& grid = light.grid;
    const int edge = (kSeesEdge + grid.stride - 1) / grid.stride;
    BouncedLight inner(grid.width - 2 * edge, grid.height - 2 * edge);
    for (int j = edge; j < grid.height - edge; ++j)
        for (int i = edge; i < grid.width - edge; ++i)
            inner.set(i - edge, j - edge, (grid.column(i) + grid.row(j)) % kPeriod, light, i, j);
    return inner;
}

// The rays of a number made by rows of the ground's height would be those of a sample that lies `height`
// columns away in the next row, which is of the same kind here; of one made by columns, `width` rows away.
TEST(TerrainChance, EverySampleHasRaysOfItsOwn) {
    for (const auto& [width, height] : {std::pair(97, 57), {57, 97}, {73, 73}}) {
        SCOPED_TRACE(width);
        innerSamples(bakedOver(wallsOver(width, height), bouncing())).expectUncorrelatedInKinds();
    }
}

TEST(TerrainChance, EverySampleOfAStrideHasRaysOfItsOwn) {
    innerSamples(bakedOver(wallsOver(193, 97), bouncing(1, 2))).expectUncorrelatedInKinds();
}

// Bakes of other seeds side by side.
TEST(TerrainChance, EverySeedHasRaysOfItsOwn) {
    constexpr int kSide = 24;
    const Heightfield ground = wallsOver(kSide + 2 * kSeesEdge, kSide + 2 * kSeesEdge);
    const std::array<std::uint64_t, 4> seeds{0, 1, 2, std::uint64_t{1} << 40};
    BouncedLight all(kSide * static_cast<int>(seeds.size()), kSide);
    for (std::size_t n = 0; n < seeds.size(); ++n) {
        const TerrainLight light = bakedOver(ground, bouncing(seeds[n]));
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i)
                all.set(static_cast<int>(n) * kSide + i, j, (i + j) % kPeriod, light, i + kSeesEdge,
                        j + kSeesEdge);
    }
    all.expectUncorrelatedInKinds();
}

// Tiles eight samples wide, beside and above one another. What they meet sends the light of the ground at
// every second sample: so they see the same where their columns also are both even or both odd.
TEST(TerrainChance, EveryTileHasRaysOfItsOwn) {
    const Heightfield fine = wallsOver(161, 193);
    const GroundLevels levels(fine);
    ASSERT_GT(levels.count(), 1);
    const Heightfield coarse = levels.part(1, glm::ivec2(0), levels.size(1)).value();
    TerrainLightSettings direct = bouncing();
    direct.bounces = 0;
    TerrainLight light = bakedOver(coarse, direct);  // in which there is no chance
    light.settings.bounces = 1;
    const FineBake bake(levels, coarse, light);
    const glm::ivec2 size(8, 48);
    const std::array lows{glm::ivec2(40, 40), glm::ivec2(104, 40), glm::ivec2(40, 96)};
    BouncedLight all(size.x * static_cast<int>(lows.size()), size.y);
    for (std::size_t n = 0; n < lows.size(); ++n) {
        const glm::ivec2 low = lows[n];
        const auto tile = bake.tile(0, low, size, [] {});
        ASSERT_TRUE(tile);
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const int kind = (low.x + i) % 2 * kPeriod + (low.x + i + low.y + j) % kPeriod;
                all.set(static_cast<int>(n) * size.x + i, j, kind, *tile, i, j);
            }
    }
    all.expectUncorrelatedInKinds();
}

TEST(TerrainChance, EverySampleOfEveryLevelHasANumberOfItsOwn) {
    std::vector<std::array<std::uint64_t, 1>> numbers;
    glm::ivec2 size(301, 131);
    for (int level = 0; level < 4; ++level, size = (size + 1) / 2)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) numbers.push_back({numberOfSample(level, size, {i, j})});
    std::sort(numbers.begin(), numbers.end());
    EXPECT_EQ(std::adjacent_find(numbers.begin(), numbers.end()), numbers.end());
    // The samples of a row are numbered on from its first one.
    EXPECT_EQ(numberOfSample(2, {301, 131}, {17, 5}), numberOfSample(2, {301, 131}, {0, 5}) + 17);
}

// What a run of paths says of its own error is how far runs of other seeds lie apart: so paths are
// independent.
TEST(TerrainChance, EveryPathHasNumbersOfItsOwn) {
    const Heightfield ground = makeGround("smooth", 41, 41, 1);
    const GroundRays rays(ground);
    SunAndSky light;
    light.toSun = glm::normalize(glm::dvec3(0.5, 0.3, 0.4));
    light.sun = glm::vec3(1);
    const auto sky = [](const glm::dvec3& d) { return glm::vec3(glm::dvec3(1 + d.x, 1 + d.y, 2 * d.z)); };
    constexpr int kRuns = 600;
    for (const int paths : {16, 64}) {
        std::vector<double> means;
        std::vector<std::array<double, 3>> all;
        double stated = 0;
        for (int run = 0; run < kRuns; ++run) {
            PathLightSetting setting;
            setting.paths = paths;
            setting.seed = static_cast<std::uint64_t>(run);
            const PathLight path = tracePathLight(rays, {3, -4}, light, sky, setting);
            means.push_back(luminance(path.mean));
            all.push_back(chanceValue(path.mean));
            stated += path.variance / kRuns;
        }
        EXPECT_EQ(placesAlike(all), "") << "seeds have the same numbers";
        EXPECT_NEAR(spreadOfAll(means) / stated, 1, 0.25) << paths;
    }
}

ChanceField whiteOf(const Noise& noise, int width, int height) {
    constexpr int kFar = 1 << 20;
    ChanceField field(width, height);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            field.at(i, j) = {static_cast<double>(noise.white(i, j)),
                              static_cast<double>(noise.white(i + kFar, j)),
                              static_cast<double>(noise.white(i, j + kFar))};
    return field;
}

// Returns noise in cells of the lattice that share no corner. Slopes have sixteen directions: cells are alike
// now and then.
ChanceField gradientsOf(const Noise& noise, int width, int height) {
    ChanceField field(width, height);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const float x = 2 * static_cast<float>(i) + 0.37f, y = 2 * static_cast<float>(j) + 0.61f;
            field.at(i, j)[0] = static_cast<double>(noise.at(x, y));
        }
    return field;
}

TEST(TerrainChance, NoiseIsAnotherAtEveryPlace) {
    for (const auto& [width, height] : {std::pair(67, 29), {29, 67}, {43, 43}}) {
        SCOPED_TRACE(width);
        expectUnrelated(whiteOf(Noise(4711), width, height));
        expectUncorrelated(gradientsOf(Noise(4711), width, height));
    }
}

TEST(TerrainChance, NoiseIsAnotherForEverySeed) {
    const ChanceField base = whiteOf(Noise(1), 61, 41), gradients = gradientsOf(Noise(1), 61, 41);
    for (const std::uint64_t seed : {0ull, 2ull, 3ull, 1ull << 40, 71ull}) {
        expectUnrelated(base, whiteOf(Noise(seed), 61, 41));
        expectUncorrelated(gradients, gradientsOf(Noise(seed), 61, 41));
    }
}

// On a tilted plane water goes to one of three neighbours, at every sample with the same chances.
TEST(TerrainChance, RiversTurnAnotherWayAtEverySample) {
    constexpr int kSide = 66;
    Landscape land;
    land.size = kSide;
    land.spacing = 10;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) land.height.push_back(static_cast<float>(1000 - x - y));
    land.uplift.assign(land.height.size(), 0.0f);
    land.talus.assign(land.height.size(), 1.0f);
    for (const std::uint64_t seed : {1ull, 2ull}) {
        Landscape eroded = land;
        erode(eroded, 1, 1e-6f, seed);
        ChanceField ways(kSide - 2, kSide - 2);
        for (int y = 1; y + 1 < kSide; ++y)
            for (int x = 1; x + 1 < kSide; ++x) {
                const int at = y * kSide + x, way = eroded.receiver[static_cast<std::size_t>(at)] - at;
                ASSERT_TRUE(way == 1 || way == kSide || way == kSide + 1) << way;
                ways.at(x - 1, y - 1)[0] = way == 1 ? 1 : way == kSide ? -1 : 0;
            }
        expectUncorrelated(ways);
    }
}

TEST(TerrainChance, DetailIsAnotherAtEveryPlaceOfItsLattice) {
    const Heightfield ground = makeGround("smooth", 11, 11, 1);
    const GroundDetail detail(ground);
    const DetailData data = detail.forKernels(TerrainLook());
    const auto value = [&](int x, int y) {
        return static_cast<double>(data.values[(y % kDetailSide) * kDetailPitch + x % kDetailSide]);
    };
    ChanceField field(kDetailSide, kDetailSide);
    for (int y = 0; y < kDetailSide; ++y)
        for (int x = 0; x < kDetailSide; ++x)
            field.at(x, y) = {value(x, y), value(x + 1, y), value(x, y + 1)};
    expectUnrelated(field);
}

}  // namespace
}  // namespace stereonav::test
