// Three passes. Along j and k whole rows are weighed and added, so that all three run over memory in order.
#include "engine/volume/gaussian.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

constexpr double kCut = 2.7;  // sigmas: 0.7 % of the weight lies beyond

// out[n] = weights[0] * middle[n] + sum over t of weights[t] * (rows[t][0][n] + rows[t][1][n])
void addPair(const float* a, const float* b, float weight, int count, float* out) {
    for (int n = 0; n < count; ++n) out[n] += weight * (a[n] + b[n]);
}

void scaled(const float* a, float weight, int count, float* out) {
    for (int n = 0; n < count; ++n) out[n] = weight * a[n];
}

void alongI(const std::vector<float>& weights, float* row, int count, std::vector<float>& padded) {
    const int reach = static_cast<int>(weights.size()) - 1;
    padded.resize(static_cast<std::size_t>(reach) * 2 + count);
    std::fill_n(padded.begin(), reach, row[0]);
    std::copy_n(row, count, padded.begin() + reach);
    std::fill_n(padded.end() - reach, reach, row[count - 1]);
    const float* middle = padded.data() + reach;
    scaled(middle, weights[0], count, row);
    for (int t = 1; t <= reach; ++t)
        addPair(middle - t, middle + t, weights[static_cast<std::size_t>(t)], count, row);
}

// Lines of `length` blocks, `block` floats each.
void alongBlocks(const std::vector<float>& weights, const float* in, float* out, int length, int block) {
    const auto at = [&](int n) {
        return in + static_cast<std::size_t>(std::clamp(n, 0, length - 1)) * block;
    };
    for (int n = 0; n < length; ++n) {
        float* to = out + static_cast<std::size_t>(n) * block;
        scaled(at(n), weights[0], block, to);
        for (int t = 1; t < static_cast<int>(weights.size()); ++t)
            addPair(at(n - t), at(n + t), weights[static_cast<std::size_t>(t)], block, to);
    }
}

}  // namespace

std::vector<float> gaussianWeights(double sigma) {
    const int reach = static_cast<int>(std::lround(kCut * sigma));
    std::vector<double> exact{1.0};
    double sum = 1;
    for (int t = 1; t <= reach; ++t) {
        exact.push_back(std::exp(-0.5 * t * t / (sigma * sigma)));
        sum += 2 * exact.back();
    }
    std::vector<float> weights;
    weights.reserve(exact.size());
    for (const double w : exact) weights.push_back(static_cast<float>(w / sum));
    return weights;
}

BoxSmoother::BoxSmoother(const glm::dvec3& sigma)
    : mWeights{gaussianWeights(sigma.x), gaussianWeights(sigma.y), gaussianWeights(sigma.z)} {}

glm::ivec3 BoxSmoother::reach() const {
    return {static_cast<int>(mWeights[0].size()) - 1, static_cast<int>(mWeights[1].size()) - 1,
            static_cast<int>(mWeights[2].size()) - 1};
}

void BoxSmoother::smooth(std::vector<float>& box, const glm::ivec3& size) {
    if (box.empty()) return;
    mOther.resize(box.size());
    const std::size_t slice = static_cast<std::size_t>(size.x) * size.y;
    for (std::size_t at = 0; at < box.size(); at += static_cast<std::size_t>(size.x))
        alongI(mWeights[0], box.data() + at, size.x, mRow);
    for (int k = 0; k < size.z; ++k)
        alongBlocks(mWeights[1], box.data() + k * slice, mOther.data() + k * slice, size.y, size.x);
    alongBlocks(mWeights[2], mOther.data(), box.data(), size.z, static_cast<int>(slice));
}

}  // namespace stereonav
