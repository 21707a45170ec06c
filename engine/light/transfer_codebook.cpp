// Transfer vectors to records and back, and records dotted with a light.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/vec2.hpp>
#include <numeric>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/light/transfer_compression.h"
#include "engine/math/half_float.h"

namespace stereonav {
namespace {

constexpr int kMostNumbers = 3 * kMaxHarmonics;
constexpr int kMostClusters = 256;
// Of the clusters, the nearest to a vector by their means, that are tried in full. Trying all of 256 leaves
// 0.9 to 1.5 % less error and takes three times as long to train (an engine block's transfer, 4 to 12
// components).
constexpr int kNearestTried = 16;

void require(bool fits, const std::string& what) {
    if (!fits) throw Error("", "transfer codebook", "expected " + what, "bake it again");
}

bool finite(const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

void check(const TransferCodebook::Parts& p) {
    require(p.shape.order >= 1 && p.shape.order <= kMaxHarmonicsOrder, "an order of 1 to 6");
    require(p.shape.channels == 1 || p.shape.channels == 3, "1 or 3 channels");
    require(p.clusters >= 0 && p.clusters <= kMostClusters, "0 to 256 clusters");
    require(p.components >= 0 && p.components <= p.shape.size(), "no more components than numbers");
    require(p.vectors.size() == static_cast<std::size_t>(p.clusters) * (p.components + 1) * p.shape.size(),
            "a mean and the components of every cluster");
    const bool bytes = p.weights == TransferCompression::Weights::Byte;
    require(p.ranges.size() == (bytes ? static_cast<std::size_t>(p.clusters) * p.components : 0),
            "a range of every component that is kept in bytes");
    require(finite(p.vectors), "finite numbers");
    require(
        std::all_of(p.ranges.begin(), p.ranges.end(),
                    [](const glm::vec2& r) { return std::isfinite(r.x) && std::isfinite(r.y) && r.y >= 0; }),
        "finite ranges");
}

void storeHalf(float value, std::uint8_t* to) {
    const std::uint16_t half = halfFromFloat(value);
    std::memcpy(to, &half, sizeof half);
}

float loadHalf(const std::uint8_t* from) {
    std::uint16_t half;
    std::memcpy(&half, from, sizeof half);
    return floatFromHalf(half);
}

// Nearest byte; a range of no width holds one value only.
std::uint8_t byteIn(const glm::vec2& range, float value) {
    const float place = range.y > 0 ? (value - range.x) / range.y + 0.5f : 0.0f;
    return place > 0 ? static_cast<std::uint8_t>(std::min(place, 255.0f)) : std::uint8_t{0};  // NaN: 0
}

glm::vec4 dotted(const float* vector, const std::vector<glm::vec4>& light) {
    glm::dvec4 sum(0.0);
    for (std::size_t i = 0; i < light.size(); ++i)
        sum += static_cast<double>(vector[i]) * glm::dvec4(light[i]);
    return sum;
}

}  // namespace

TransferCodebook::TransferCodebook(Parts parts) : mParts(std::move(parts)) {
    check(mParts);
    const int size = mParts.shape.size(), k = mParts.clusters, m = mParts.components;
    mClusterSize = static_cast<std::size_t>(m + 1) * size;
    mMeans.resize(static_cast<std::size_t>(k) * size);
    mDirections.resize(static_cast<std::size_t>(k) * size * m);
    for (int c = 0; c < k; ++c)
        for (int i = 0; i < size; ++i) {
            mMeans[i * k + c] = cluster(c)[i];
            for (int j = 0; j < m; ++j)
                mDirections[(static_cast<std::size_t>(c) * size + i) * m + j] =
                    cluster(c)[(j + 1) * size + i];
        }
}

std::size_t TransferCodebook::recordBytes() const {
    if (mParts.clusters == 0) return 2 * static_cast<std::size_t>(mParts.shape.size());
    return 1 + static_cast<std::size_t>(mParts.components) *
                   (mParts.weights == TransferCompression::Weights::Half ? 2 : 1);
}

void TransferCodebook::weightsIn(int c, const float* vector, float* weights) const {
    const int size = mParts.shape.size(), m = mParts.components;
    const float* mean = cluster(c);
    const float* row = m > 0 ? &mDirections[static_cast<std::size_t>(c) * size * m] : nullptr;
    std::fill(weights, weights + m, 0.0f);
    for (int i = 0; i < size; ++i, row += m) {
        const float offset = vector[i] - mean[i];
        for (int j = 0; j < m; ++j) weights[j] += row[j] * offset;
    }
}

// The error is what is left of the distance from the mean when the components have taken their part. Looked
// for among the clusters of the nearest means.
int TransferCodebook::bestCluster(const float* vector) const {
    const int size = mParts.shape.size(), k = mParts.clusters, m = mParts.components;
    if (k == 0) return 0;
    std::array<float, kMostClusters> distance{};
    for (int i = 0; i < size; ++i) {
        const float* means = &mMeans[static_cast<std::size_t>(i) * k];
        for (int c = 0; c < k; ++c) distance[c] += (vector[i] - means[c]) * (vector[i] - means[c]);
    }
    std::array<int, kMostClusters> order;
    std::iota(order.begin(), order.begin() + k, 0);
    const int tried = std::min(k, m > 0 ? kNearestTried : 1);
    std::partial_sort(order.begin(), order.begin() + tried, order.begin() + k, [&](int a, int b) {
        return distance[a] != distance[b] ? distance[a] < distance[b] : a < b;
    });
    int best = 0;
    float least = INFINITY;
    std::array<float, kMostNumbers> weights;
    for (int n = 0; n < tried; ++n) {
        const int c = order[n];
        weightsIn(c, vector, weights.data());
        float left = distance[c];
        for (int j = 0; j < m; ++j) left -= weights[j] * weights[j];
        if (left < least) best = c, least = left;
    }
    return best;
}

void TransferCodebook::encode(const float* vector, std::uint8_t* record) const {
    encodeIn(bestCluster(vector), vector, record);
}

void TransferCodebook::encodeIn(int c, const float* vector, std::uint8_t* record) const {
    if (mParts.clusters == 0) {
        for (int i = 0; i < mParts.shape.size(); ++i) storeHalf(vector[i], record + 2 * i);
        return;
    }
    std::array<float, kMostNumbers> weights;
    weightsIn(c, vector, weights.data());
    *record++ = static_cast<std::uint8_t>(c);
    const bool bytes = mParts.weights == TransferCompression::Weights::Byte;
    for (int j = 0; j < mParts.components; ++j) {
        if (bytes)
            record[j] = byteIn(mParts.ranges[c * mParts.components + j], weights[j]);
        else
            storeHalf(weights[j], record + 2 * j);
    }
}

float TransferCodebook::weight(const std::uint8_t* record, int c, int j) const {
    if (mParts.weights == TransferCompression::Weights::Half) return loadHalf(record + 1 + 2 * j);
    const glm::vec2& range = mParts.ranges[c * mParts.components + j];
    return range.x + range.y * static_cast<float>(record[1 + j]);
}

void TransferCodebook::decode(const std::uint8_t* record, float* vector) const {
    const int size = mParts.shape.size();
    if (mParts.clusters == 0) {
        for (int i = 0; i < size; ++i) vector[i] = loadHalf(record + 2 * i);
        return;
    }
    const int c = std::min<int>(record[0], mParts.clusters - 1);
    const float* from = cluster(c);
    std::copy(from, from + size, vector);
    for (int j = 0; j < mParts.components; ++j) {
        const float w = weight(record, c, j);
        for (int i = 0; i < size; ++i) vector[i] += w * from[(j + 1) * size + i];
    }
}

TransferLight TransferCodebook::prepareLight(std::span<const glm::vec3> light) const {
    const int channels = mParts.shape.channels, m = mParts.components;
    if (light.size() != static_cast<std::size_t>(harmonicsCount(mParts.shape.order)))
        throw Error("", "light",
                    "expected " + std::to_string(harmonicsCount(mParts.shape.order)) + " coefficients, got " +
                        std::to_string(light.size()),
                    "project it to the transfer's order");
    std::vector<glm::vec4> numbers;
    for (const glm::vec3& l : light)
        for (int k = 0; k < channels; ++k) {
            glm::vec4 entry(l, 0.0f);
            for (int other = 0; other < 3 && channels == 3; ++other)
                if (other != k) entry[other] = 0;
            numbers.push_back(entry);
        }
    if (mParts.clusters == 0) return {numbers};
    TransferLight prepared;
    const bool bytes = mParts.weights == TransferCompression::Weights::Byte;
    for (int c = 0; c < mParts.clusters; ++c) {
        const std::size_t mean = prepared.entries.size();
        prepared.entries.push_back(dotted(cluster(c), numbers));
        for (int j = 0; j < m; ++j) {
            const glm::vec4 direction = dotted(cluster(c) + (j + 1) * mParts.shape.size(), numbers);
            const glm::vec2 range = bytes ? mParts.ranges[c * m + j] : glm::vec2(0, 1);
            prepared.entries[mean] += range.x * direction;
            prepared.entries.push_back(range.y * direction);
        }
    }
    return prepared;
}

glm::vec3 TransferCodebook::dot(const std::uint8_t* record, const TransferLight& light) const {
    glm::vec4 sum(0.0f);
    if (mParts.clusters == 0) {
        for (const glm::vec4& entry : light.entries) {
            sum += loadHalf(record) * entry;
            record += 2;
        }
        return sum;
    }
    const int m = mParts.components;
    const glm::vec4* entry = &light.entries[std::min<int>(record[0], mParts.clusters - 1) * (m + 1)];
    sum = *entry;
    if (mParts.weights == TransferCompression::Weights::Byte)
        for (int j = 1; j <= m; ++j) sum += static_cast<float>(record[j]) * entry[j];
    else
        for (int j = 0; j < m; ++j) sum += loadHalf(record + 1 + 2 * j) * entry[j + 1];
    return sum;
}

}  // namespace stereonav
