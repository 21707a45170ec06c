// Separable smoothing against the sum over all neighbours at once, and against what a Gaussian must keep.
#include "engine/volume/gaussian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "test_volumes.h"

namespace stereonav {
namespace {

using test::Random;

double sumOf(const std::vector<float>& half) {
    return 2 * std::accumulate(half.begin(), half.end(), 0.0) - half[0];
}

TEST(GaussianWeights, AreAGaussianCutOffAndSumToOne) {
    for (const double sigma : {0.2, 0.5, 0.8, 1.0, 1.7, 3.0, 10.0}) {
        const std::vector<float> weights = gaussianWeights(sigma);
        ASSERT_EQ(weights.size(), static_cast<std::size_t>(std::lround(2.7 * sigma)) + 1) << sigma;
        EXPECT_NEAR(sumOf(weights), 1, 1e-6) << sigma;
        for (std::size_t n = 0; n < weights.size(); ++n)
            EXPECT_NEAR(weights[n] / weights[0],
                        std::exp(-0.5 * static_cast<double>(n * n) / (sigma * sigma)), 1e-6)
                << sigma << ' ' << n;
    }
}

TEST(GaussianWeights, SpreadByAboutSigma) {
    for (const double sigma : {1.0, 2.0, 5.0, 12.0}) {
        const std::vector<float> weights = gaussianWeights(sigma);
        double variance = 0;
        for (std::size_t n = 1; n < weights.size(); ++n)
            variance += 2.0 * weights[n] * static_cast<double>(n * n);
        // The variance of a Gaussian cut at c sigmas is 1 - 2 c phi(c) / erf(c / sqrt 2) of sigma's square.
        const double c = (static_cast<double>(weights.size()) - 0.5) / sigma;
        const double phi = std::exp(-0.5 * c * c) / std::sqrt(2 * 3.14159265358979);
        EXPECT_NEAR(variance / (sigma * sigma), 1 - 2 * c * phi / std::erf(c / std::sqrt(2.0)), 0.01)
            << sigma;
    }
}

TEST(GaussianWeights, OfNoWidthAreTheMiddleAlone) {
    for (const double sigma : {0.0, 1e-300, 1e-9, 0.1}) {
        const std::vector<float> weights = gaussianWeights(sigma);
        ASSERT_EQ(weights.size(), 1u) << sigma;
        EXPECT_EQ(weights[0], 1.0f) << sigma;
    }
}

std::vector<float> randomBox(const glm::ivec3& size, unsigned seed) {
    Random random(seed);
    std::vector<float> box(static_cast<std::size_t>(size.x) * size.y * size.z);
    for (float& v : box) v = static_cast<float>(random.between(-1000, 1000));
    return box;
}

float at(const std::vector<float>& box, const glm::ivec3& size, const glm::ivec3& v) {
    const glm::ivec3 c = glm::clamp(v, glm::ivec3(0), size - 1);
    return box[(static_cast<std::size_t>(c.z) * size.y + c.y) * size.x + c.x];
}

// All three axes at once, in double precision.
double direct(const std::vector<float>& box, const glm::ivec3& size, const glm::dvec3& sigma,
              const glm::ivec3& v) {
    const std::vector<float> w[3] = {gaussianWeights(sigma.x), gaussianWeights(sigma.y),
                                     gaussianWeights(sigma.z)};
    const glm::ivec3 reach(w[0].size() - 1, w[1].size() - 1, w[2].size() - 1);
    double sum = 0;
    for (int z = -reach.z; z <= reach.z; ++z)
        for (int y = -reach.y; y <= reach.y; ++y)
            for (int x = -reach.x; x <= reach.x; ++x)
                sum += static_cast<double>(w[0][std::abs(x)]) * w[1][std::abs(y)] * w[2][std::abs(z)] *
                       at(box, size, v + glm::ivec3(x, y, z));
    return sum;
}

TEST(BoxSmoother, IsTheSumOverAllNeighbours) {
    for (const glm::ivec3 size : {glm::ivec3(9, 8, 7), glm::ivec3(1, 1, 1), glm::ivec3(2, 1, 5),
                                  glm::ivec3(1, 9, 2), glm::ivec3(16, 3, 1)})
        for (const glm::dvec3 sigma : {glm::dvec3(1, 0.7, 1.5), glm::dvec3(0, 2, 0), glm::dvec3(3, 0, 0.9)}) {
            const std::vector<float> before = randomBox(size, 11);
            std::vector<float> box = before;
            BoxSmoother smoother(sigma);
            smoother.smooth(box, size);
            for (int k = 0; k < size.z; ++k)
                for (int j = 0; j < size.y; ++j)
                    for (int i = 0; i < size.x; ++i)
                        ASSERT_NEAR(at(box, size, {i, j, k}), direct(before, size, sigma, {i, j, k}), 1e-2)
                            << size.x << 'x' << size.y << 'x' << size.z << " at " << i << j << k;
        }
}

TEST(BoxSmoother, KeepsConstantsEverywhereAndRampsInside) {
    const glm::ivec3 size(24, 21, 19);
    BoxSmoother smoother({1.2, 0.9, 1.6});
    const glm::ivec3 reach = smoother.reach();
    EXPECT_EQ(reach, glm::ivec3(3, 2, 4));
    std::vector<float> flat(static_cast<std::size_t>(size.x) * size.y * size.z, -450.0f), ramp = flat;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                ramp[(static_cast<std::size_t>(k) * size.y + j) * size.x + i] =
                    static_cast<float>(3 * i - 5 * j + 7 * k);
    smoother.smooth(flat, size);
    smoother.smooth(ramp, size);
    for (const float v : flat) ASSERT_NEAR(v, -450, 1e-3);
    int inside = 0;
    for (int k = reach.z; k < size.z - reach.z; ++k)
        for (int j = reach.y; j < size.y - reach.y; ++j)
            for (int i = reach.x; i < size.x - reach.x; ++i, ++inside)
                ASSERT_NEAR(at(ramp, size, {i, j, k}), 3 * i - 5 * j + 7 * k, 1e-3);
    EXPECT_GT(inside, 1000);
}

TEST(BoxSmoother, AnImpulseBecomesTheProductOfTheWeights) {
    const glm::ivec3 size(15, 15, 15), middle(7, 7, 7);
    const glm::dvec3 sigma(1.0, 1.5, 2.0);
    std::vector<float> box(15 * 15 * 15, 0.0f);
    box[(7 * 15 + 7) * 15 + 7] = 1000;
    BoxSmoother smoother(sigma);
    smoother.smooth(box, size);
    const auto weight = [&](int axis, int away) {
        const std::vector<float> w = gaussianWeights(sigma[axis]);
        return std::abs(away) < static_cast<int>(w.size()) ? w[static_cast<std::size_t>(std::abs(away))]
                                                           : 0.0f;
    };
    double sum = 0;
    for (int k = 0; k < 15; ++k)
        for (int j = 0; j < 15; ++j)
            for (int i = 0; i < 15; ++i) {
                const double expected = 1000.0 * weight(0, i - 7) * weight(1, j - 7) * weight(2, k - 7);
                ASSERT_NEAR(at(box, size, {i, j, k}), expected, 1e-3);
                sum += at(box, size, {i, j, k});
            }
    EXPECT_NEAR(sum, 1000, 0.01);
}

TEST(BoxSmoother, CanBeUsedAgainOnBoxesOfOtherSizes) {
    BoxSmoother used({1.0, 1.0, 1.0});
    for (const glm::ivec3 size : {glm::ivec3(12, 10, 8), glm::ivec3(3, 2, 2), glm::ivec3(12, 10, 8)}) {
        std::vector<float> again = randomBox(size, 5), fresh = again;
        used.smooth(again, size);
        BoxSmoother({1.0, 1.0, 1.0}).smooth(fresh, size);
        ASSERT_EQ(again, fresh);
    }
    std::vector<float> none;
    used.smooth(none, {0, 0, 0});
    EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace stereonav
