// Tests of random numbers at the pixels of a picture (voxels, samples of a ground) whose places are all
// alike: whether any two of them were made of the same random numbers. Means do not show that.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace stereonav::test {

// Returns two places whose values are all within `tolerance` of each other: "3 and 17"; "" where there are
// none. The values must come from far more than places^2 possible ones, or two are alike by chance.
template <std::size_t count>
std::string placesAlike(const std::vector<std::array<double, count>>& values, double tolerance = 0) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    for (std::size_t n = 0; n < order.size(); ++n)
        for (std::size_t m = n + 1; m < order.size(); ++m) {
            const auto &a = values[order[n]], &b = values[order[m]];
            if (!(b[0] - a[0] <= tolerance)) break;
            bool alike = true;
            for (std::size_t k = 1; k < count; ++k) alike = alike && std::abs(a[k] - b[k]) <= tolerance;
            if (alike) return std::to_string(order[n]) + " and " + std::to_string(order[m]);
        }
    return "";
}

// Returns the variance of the values around their mean.
inline double spreadOfAll(const std::vector<double>& values) {
    const double count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return squares / (count - 1);
}

// Three numbers for each pixel of a picture, row by row. With one number two pixels would be alike now and
// then: there are only some million floats of about the same size.
struct ChanceField {
    using Value = std::array<double, 3>;
    int width = 0, height = 0;
    std::vector<Value> values;

    ChanceField(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * h) {}
    Value& at(int x, int y) { return values[static_cast<std::size_t>(y) * width + x]; }
    const Value& at(int x, int y) const { return values[static_cast<std::size_t>(y) * width + x]; }
    std::vector<double> first() const {
        std::vector<double> numbers;
        for (const Value& value : values) numbers.push_back(value[0]);
        return numbers;
    }
};
inline ChanceField oneAboveTheOther(const ChanceField& a, const ChanceField& b) {
    ChanceField both(a.width, a.height + b.height);
    std::copy(b.values.begin(), b.values.end(),
              std::copy(a.values.begin(), a.values.end(), both.values.begin()));
    return both;
}
template <typename Color>  // Color: a vector of GLM
ChanceField::Value chanceValue(const Color& c) {
    return {static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.z)};
}

// Replaces the first numbers by their ranks, from -1 to 1; equal ones have the same rank. Then the
// distribution has no influence, and a few outliers have little.
inline ChanceField byRank(const ChanceField& field) {
    const std::vector<double> numbers = field.first();
    std::vector<std::size_t> order(numbers.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    ChanceField ranked(field.width, field.height);
    for (std::size_t from = 0, end = 0; from < order.size(); from = end) {
        while (end < order.size() && numbers[order[end]] == numbers[order[from]]) ++end;
        const double rank = static_cast<double>(from + end) / static_cast<double>(order.size()) - 1;
        for (std::size_t n = from; n < end; ++n) ranked.values[order[n]][0] = rank;
    }
    return ranked;
}

// Distance of the correlation of pairs from that of independent ones, in its standard deviations.
class PairSums {
public:
    void add(double a, double b) { ++mPairs, mA += a, mB += b, mAA += a * a, mBB += b * b, mAB += a * b; }
    // Returns 0 for few pairs.
    double correlation_z() const {
        constexpr double kFewest = 100;
        const double spread = (mAA - mA * mA / mPairs) * (mBB - mB * mB / mPairs);
        if (mPairs < kFewest || !(spread > 0)) return 0;
        return (mAB - mA * mB / mPairs) / std::sqrt(spread) * std::sqrt(mPairs);
    }

private:
    double mPairs = 0, mA = 0, mB = 0, mAA = 0, mBB = 0, mAB = 0;
};

// Compares the first numbers of pixels dx columns and dy rows apart; dy >= 0.
inline double lagCorrelation_z(const ChanceField& field, int dx, int dy) {
    PairSums sums;
    for (int y = 0; y + dy < field.height; ++y)
        for (int x = std::max(0, -dx); x < field.width - std::max(0, dx); ++x)
            sums.add(field.at(x, y)[0], field.at(x + dx, y + dy)[0]);
    return sums.correlation_z();
}
inline double diagonalCorrelation_z(const ChanceField& field) {
    PairSums sums;
    for (int y = 0; y < std::min(field.width, field.height); ++y)
        for (int x = 0; x < y; ++x) sums.add(field.at(x, y)[0], field.at(y, x)[0]);
    return sums.correlation_z();
}

constexpr double kMostCorrelation_z = 5.5;

// Expects that no first number, which is a rank, is correlated with that of the pixel at any distance in
// columns and rows, nor with that of the pixel across the diagonal. With 10,000 correlations of independent
// numbers, one of 2,600 fields has one that is as far off as this.
inline void expectRanksUncorrelated(const ChanceField& ranked) {
    EXPECT_GT(spreadOfAll(ranked.first()), 0) << "there is no chance in it";
    for (int dy = 0; dy < ranked.height; ++dy)
        for (int dx = dy > 0 ? 1 - ranked.width : 1; dx < ranked.width; ++dx) {
            const double z = lagCorrelation_z(ranked, dx, dy);
            ASSERT_LE(std::abs(z), kMostCorrelation_z) << "with what lies " << dx << ", " << dy << " from it";
        }
    EXPECT_LE(std::abs(diagonalCorrelation_z(ranked)), kMostCorrelation_z) << "across the diagonal";
}
inline void expectUncorrelated(const ChanceField& field) {
    expectRanksUncorrelated(byRank(field));
}

// Expects that no two pixels have the same value, either.
inline void expectUnrelated(const ChanceField& field) {
    EXPECT_EQ(placesAlike(field.values), "") << "of rows of " << field.width;
    expectUncorrelated(field);
}

// Expects of two fields of the same size, from other numbers, that no value is correlated with that of the
// other in the same place.
inline void expectUncorrelated(const ChanceField& a, const ChanceField& b) {
    PairSums sums;
    const ChanceField ofA = byRank(a), ofB = byRank(b);
    for (std::size_t n = 0; n < a.values.size(); ++n) sums.add(ofA.values[n][0], ofB.values[n][0]);
    EXPECT_LE(std::abs(sums.correlation_z()), kMostCorrelation_z);
}

// Expects that no value of one is in the other, either.
inline void expectUnrelated(const ChanceField& a, const ChanceField& b) {
    EXPECT_EQ(placesAlike(oneAboveTheOther(a, b).values), "") << "of " << a.values.size() << " in each";
    expectUncorrelated(a, b);
}

}  // namespace stereonav::test
