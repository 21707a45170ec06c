// The numbers that choose paths of light: every pixel, texel, eye, seed, sample and vertex has its own. All
// places of these scenes see the same, so that they are alike where their numbers are.
#include <gtest/gtest.h>

#include "engine/light/paths/path_numbers.h"
#include "engine/light/paths/pixel_path.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "tests/light/light_scenes.h"
#include "tests/support/chance.h"

namespace stereonav {
namespace {

using namespace test;

// A sky of which no two pixels are alike: what a path finds tells its direction.
LightSetup chanceSky() {
    constexpr int kWide = 128, kHigh = 64;
    Random random(3);
    std::vector<glm::vec3> pixels;
    for (int n = 0; n < kWide * kHigh; ++n) {
        const auto number = [&] { return static_cast<float>(random.between(0.5, 1.5)); };
        const float r = number(), g = number(), b = number();
        pixels.emplace_back(r, g, b);
    }
    LightSetup setup;
    setup.probe = std::make_shared<LightProbe>(kWide, kHigh, pixels, "chance");
    setup.bounces = 1;
    return setup;
}

// Level from the middle on: the surface that looks along `axis`.
GreyVolume levelVolume(const glm::ivec3& size, int axis) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = glm::dvec3(0x1p-10);  // whole steps: every texel lies exactly alike
    return solidVolume(frame, [=](const glm::dvec3& v) { return 0.5 * size[axis] - v[axis]; });
}

TexelSampling independent(std::uint64_t seed = 1) {
    TexelSampling sampling;
    sampling.lowDiscrepancy = false;
    sampling.seed = seed;
    return sampling;
}

// Every pixel sees the same place.
Plane<TexelSum> pixelsOf(int width, int height, int samples, const TexelSampling& sampling,
                         std::uint32_t eye = 0, bool inTwoParts = false) {
    static const VolumeScene scene = [] {
        VolumeScene level;
        level.field = levelVolume({16, 16, 16}, 2);
        Progress quiet;
        level.cells = findSurfaceCells(level.field, {}, quiet);
        return level;
    }();
    EyeView view;
    view.eye = view.head = glm::dvec3(7.25, 7.5, 16) * 0x1p-10;
    view.xMin = view.xMax = view.yMin = view.yMax = 0;
    view.width = width, view.height = height;
    Plane<float> depths(width, height);
    for (int y = 0; y < height; ++y) std::fill_n(depths.row(y), width, 8 * 0x1p-10f);
    Plane<TexelSum> sums;
    Progress quiet;
    const PixelPaths paths(scene, chanceSky(), sampling);
    if (inTwoParts) paths.add(view, depths, eye, samples / 2, sums, quiet);
    paths.add(view, depths, eye, inTwoParts ? samples - samples / 2 : samples, sums, quiet);
    return sums;
}

ChanceField pathLightOf(const Plane<TexelSum>& sums) {
    ChanceField field(sums.width(), sums.height());
    for (int y = 0; y < field.height; ++y)
        for (int x = 0; x < field.width; ++x) field.at(x, y) = chanceValue(sums.at(x, y).mean);
    return field;
}

TEST(PathChance, EveryPixelHasNumbersOfItsOwn) {
    for (const TexelSampling& sampling : {TexelSampling(), independent()}) {
        expectUnrelated(pathLightOf(pixelsOf(67, 23, 16, sampling)));
        expectUnrelated(pathLightOf(pixelsOf(23, 67, 16, sampling)));
        expectUnrelated(pathLightOf(pixelsOf(40, 40, 16, sampling)));
    }
}

TEST(PathChance, EveryEyeAndEverySeedHasNumbersOfItsOwn) {
    for (const bool lowDiscrepancy : {false, true}) {
        const auto picture = [&](std::uint64_t seed, std::uint32_t eye) {
            TexelSampling sampling = independent(seed);
            sampling.lowDiscrepancy = lowDiscrepancy;
            return pathLightOf(pixelsOf(67, 23, 16, sampling, eye));
        };
        const ChanceField base = picture(1, 0);
        for (const std::uint32_t eye : {1u, 2u, 7u}) expectUnrelated(base, picture(1, eye));
        for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{2}, 1 | std::uint64_t{1} << 40})
            expectUnrelated(base, picture(seed, 0));
    }
}

// Pixels vary as their own samples say: so these are independent, also where they came in two parts.
TEST(PathChance, EverySampleHasNumbersOfItsOwn) {
    for (const int samples : {2, 16, 64})
        for (const bool inTwoParts : {false, true}) {
            const Plane<TexelSum> sums = pixelsOf(61, 59, samples, independent(), 0, inTwoParts);
            std::vector<double> light;
            double stated = 0;
            for (int y = 0; y < sums.height(); ++y)
                for (int x = 0; x < sums.width(); ++x) {
                    const TexelSum& sum = sums.at(x, y);
                    ASSERT_EQ(sum.samples, static_cast<float>(samples));
                    light.push_back(luminanceOf(sum.mean));
                    stated += double(sum.squares) / (double(samples) * (samples - 1));
                }
            stated /= static_cast<double>(light.size());
            EXPECT_NEAR(spreadOfAll(light) / stated, 1, 0.15) << samples << " " << inTwoParts;
        }
}

// Texels in the level of the surface, but for those at the faces.
struct LevelTexels {
    int width = 0, height = 0;
    std::vector<glm::ivec3> at;
};
LevelTexels texelsOfLevel(const glm::ivec3& size, int axis) {
    const int across = (axis + 1) % 3, down = (axis + 2) % 3;
    constexpr int kFace = 3;
    LevelTexels texels{size[across] - 2 * kFace, size[down] - 2 * kFace, {}};
    for (int j = 0; j < texels.height; ++j)
        for (int i = 0; i < texels.width; ++i) {
            glm::ivec3 texel;
            texel[axis] = size[axis] / 2;
            texel[across] = i + kFace;
            texel[down] = j + kFace;
            texels.at.push_back(texel);
        }
    return texels;
}

constexpr int kChanceOrder = 3;

ChanceField::Value numbersOf(const std::vector<float>& transfer, std::size_t texel) {
    const float* const first = &transfer[texel * harmonicsCount(kChanceOrder)];
    return {static_cast<double>(first[1]), static_cast<double>(first[3]), static_cast<double>(first[6])};
}

TEST(PathChance, EveryTexelHasNumbersOfItsOwn) {
    for (const auto& [size, axis] : {std::pair(glm::ivec3(57, 31, 12), 2),
                                     {glm::ivec3(31, 57, 12), 2},
                                     {glm::ivec3(12, 57, 31), 0},
                                     {glm::ivec3(57, 12, 31), 1}}) {
        SCOPED_TRACE(axis);
        const GreyVolume volume = levelVolume(size, axis);
        const TexelLighter lighter(volume, volume.frame, chanceSky(), independent());
        const LevelTexels texels = texelsOfLevel(size, axis);
        std::vector<TexelSum> sums(texels.at.size());
        lighter.addIrradiance(texels.at, 16, sums);
        ChanceField light(texels.width, texels.height);
        for (std::size_t n = 0; n < sums.size(); ++n) {
            ASSERT_EQ(sums[n].samples, 16);
            light.values[n] = chanceValue(sums[n].mean);
        }
        expectUnrelated(light);
        std::vector<float> transfer(sums.size() * harmonicsCount(kChanceOrder));
        std::vector<std::uint8_t> alive(sums.size());
        lighter.addTransfer(texels.at, 0, 16, kChanceOrder, 1, transfer, alive);
        ChanceField sent(texels.width, texels.height);
        for (std::size_t n = 0; n < sums.size(); ++n) sent.values[n] = numbersOf(transfer, n);
        expectUnrelated(sent);
    }
}

// Layers of texels one above the other: those of the surfaces at their own values.
TEST(PathChance, EveryLayerHasNumbersOfItsOwn) {
    const glm::ivec3 size(40, 30, 16);
    const GreyVolume volume = levelVolume(size, 2);
    const TexelLighter lighter(volume, volume.frame, chanceSky(), independent());
    std::vector<ChanceField> layers;
    for (const int layer : {7, 8, 9}) {
        LevelTexels texels = texelsOfLevel(size, 2);
        for (glm::ivec3& texel : texels.at) texel.z = layer;
        std::vector<TexelSum> sums(texels.at.size());
        lighter.addIrradiance(texels.at, 16, sums);
        layers.emplace_back(texels.width, texels.height);
        for (std::size_t n = 0; n < sums.size(); ++n) layers.back().values[n] = chanceValue(sums[n].mean);
    }
    expectUnrelated(layers[0], layers[1]);
    expectUnrelated(layers[0], layers[2]);
    expectUnrelated(layers[1], layers[2]);
}

// Sums of transfer go on from a sample: the parts are of other paths than the first.
TEST(PathChance, TransferGoesOnWithOtherSamples) {
    const glm::ivec3 size(40, 30, 12);
    const GreyVolume volume = levelVolume(size, 2);
    const TexelLighter lighter(volume, volume.frame, chanceSky(), independent());
    const LevelTexels texels = texelsOfLevel(size, 2);
    const auto part = [&](int first) {
        std::vector<float> transfer(texels.at.size() * harmonicsCount(kChanceOrder));
        std::vector<std::uint8_t> alive(texels.at.size());
        lighter.addTransfer(texels.at, first, 8, kChanceOrder, 1, transfer, alive);
        ChanceField field(texels.width, texels.height);
        for (std::size_t n = 0; n < texels.at.size(); ++n) field.values[n] = numbersOf(transfer, n);
        return field;
    };
    expectUnrelated(part(0), part(8));
    expectUnrelated(part(8), part(16));
}

// The numbers themselves: keys are a permutation of what they are made of.
TEST(PathChance, NoTwoPlacesOfAGridHaveTheSameKey) {
    for (const std::uint64_t seed : {0ull, 1ull, 77ull, 1ull << 40}) {
        std::vector<std::array<double, 1>> keys;
        for (std::uint64_t texel = 0; texel < 200'000; ++texel)
            keys.push_back({double(pathKey(seed, texel))});
        EXPECT_EQ(placesAlike(keys), "") << seed;
    }
    std::vector<std::array<double, 1>> keys;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (std::uint64_t eye = 0; eye < 4; ++eye)
            for (std::uint64_t texel = 0; texel < 20; ++texel)
                keys.push_back({double(pathKey(seed, eye << 40 | texel))});
    EXPECT_EQ(placesAlike(keys), "");
}

// Vertices of a path and what is chosen at each of them.
TEST(PathChance, EveryVertexAndEveryChoiceHasNumbersOfItsOwn) {
    constexpr int kVertices = 9, kSamples = 1000;
    std::vector<std::uint32_t> pairs;
    for (int vertex = 0; vertex < kVertices; ++vertex)
        for (const PathPair pair : {PathPair::Direction, PathPair::Probe, PathPair::Roulette})
            pairs.push_back(pairNumber(vertex, pair));
    std::sort(pairs.begin(), pairs.end());
    EXPECT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end());
    for (const bool low : {false, true}) {
        SCOPED_TRACE(low ? "low discrepancy" : "independent");
        // Rows: each dimension of one path's numbers; columns: its samples.
        std::vector<std::vector<double>> dimensions;
        for (const std::uint64_t texel : {5u, 6u})
            for (const std::uint32_t pair : pairs) {
                std::vector<double> x, y;
                for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
                    const std::uint32_t key = pathKey(1, texel);
                    const glm::vec2 u =
                        low ? sobolPair(key, pair, sample) : independentPair(key, pair, sample);
                    x.push_back(static_cast<double>(u.x));
                    y.push_back(static_cast<double>(u.y));
                }
                dimensions.push_back(x);
                dimensions.push_back(y);
            }
        double worst = 0;
        for (std::size_t a = 0; a < dimensions.size(); ++a)
            for (std::size_t b = a + 1; b < dimensions.size(); ++b) {
                double sum = 0;
                for (int n = 0; n < kSamples; ++n) sum += (dimensions[a][n] - 0.5) * (dimensions[b][n] - 0.5);
                worst = std::max(worst, std::abs(12 * sum / std::sqrt(double(kSamples))));
            }
        // One of 5,778 pairs of independent numbers is as far off as this once in 60 times.
        EXPECT_LT(worst, 4.7);
    }
}

}  // namespace
}  // namespace stereonav
