// Finds the clusters and components of transfer vectors (Sloan et al. 2003, section 4): first k-means, whose
// error is the distance from the mean, then rounds in which it is what the components leave. Differs in
// training on a part of the vectors where there are many.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/vec2.hpp>
#include <limits>
#include <numeric>
#include <random>
#include <string>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/light/principal_axes.h"
#include "engine/light/transfer_compression.h"
#include "engine/math/half_float.h"

namespace stereonav {
namespace {

constexpr int kTrainingBlock = 256;  // vectors a task
constexpr int kMeansRounds = 5;      // of plain k-means, before components take part

using Parts = TransferCodebook::Parts;
using Weights = TransferCompression::Weights;

void requireSetting(bool fits, const char* name, const std::string& range, int given) {
    if (!fits)
        throw Error("", name, "expected " + range + ", got " + std::to_string(given), "give another number");
}

void check(std::span<const float> vectors, const TransferShape& shape, const TransferCompression& s) {
    requireSetting(shape.order >= 1 && shape.order <= kMaxHarmonicsOrder, "order", "1 to 6", shape.order);
    requireSetting(shape.channels == 1 || shape.channels == 3, "channels", "1 or 3", shape.channels);
    requireSetting(s.clusters >= 0 && s.clusters <= 256, "clusters", "0 to 256", s.clusters);
    requireSetting(s.components >= 0 && s.components <= shape.size(), "components",
                   "0 to " + std::to_string(shape.size()), s.components);
    requireSetting(s.trainingVectors >= 1, "training vectors", "1 or more", s.trainingVectors);
    requireSetting(s.rounds >= 0, "rounds", "0 or more", s.rounds);
    if (vectors.size() % shape.size() != 0)
        throw Error("", "transfer vectors",
                    "expected a multiple of " + std::to_string(shape.size()) + " numbers, got " +
                        std::to_string(vectors.size()),
                    "give whole vectors");
    const auto bad = std::find_if(vectors.begin(), vectors.end(),
                                  [](float v) { return !(std::abs(v) <= kLargestHalf); });  // NaN too
    if (bad != vectors.end())
        throw Error("", "transfer vector " + std::to_string((bad - vectors.begin()) / shape.size()),
                    "expected numbers within 65504, got " + std::to_string(*bad), "bake it again");
}

// body(first, last) over blocks of 0..count.
void forBlocks(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
    const auto blocks = static_cast<int>((count + kTrainingBlock - 1) / kTrainingBlock);
    parallelFor(blocks, [&](int b) {
        const std::size_t first = static_cast<std::size_t>(b) * kTrainingBlock;
        body(first, std::min(count, first + kTrainingBlock));
    });
}

// One vector of each of `wanted` equal stretches, at a place in it drawn at random, so that no period of the
// vectors' order (bricks, rows) is met.
std::vector<float> spread(std::span<const float> vectors, int size, int wanted) {
    const std::size_t count = vectors.size() / size;
    if (count <= static_cast<std::size_t>(wanted)) return {vectors.begin(), vectors.end()};
    std::mt19937_64 random(1);
    std::vector<float> chosen;
    for (int n = 0; n < wanted; ++n) {
        const std::size_t first = count * n / wanted, last = count * (n + 1) / wanted;
        const auto from = vectors.begin() + (first + random() % (last - first)) * size;
        chosen.insert(chosen.end(), from, from + size);
    }
    return chosen;
}

double squaredDistance(const float* a, const float* b, int size) {
    double sum = 0;
    for (int i = 0; i < size; ++i)
        sum += (static_cast<double>(a[i]) - b[i]) * (static_cast<double>(a[i]) - b[i]);
    return sum;
}

// Training vectors and the clusters they are in.
class Training {
public:
    Training(std::vector<float> vectors, const TransferShape& shape, const TransferCompression& settings)
        : mVectors(std::move(vectors)), mSize(shape.size()), mCount(mVectors.size() / mSize) {
        mParts.shape = shape;
        mParts.clusters = static_cast<int>(std::min<std::size_t>(settings.clusters, mCount));
        mParts.weights = Weights::Half;
        mOwner.assign(mCount, 0);
        mError.assign(mCount, 0.0);
    }

    Parts run(int components, int rounds) {
        if (mCount == 0) return nothing();
        startApart();
        for (int round = 0; round < kMeansRounds; ++round) improve();
        widen(components);
        for (int round = 0; round < rounds; ++round) improve();
        return mParts;
    }

private:
    const float* vector(std::size_t n) const { return &mVectors[n * mSize]; }

    // All vectors to come are one cluster around 0.
    Parts nothing() {
        mParts.clusters = 1;
        mParts.vectors.assign(mSize, 0.0f);
        return mParts;
    }

    // k-means++ (Arthur and Vassilvitskii 2007): means far apart, drawn by the squared distance to the
    // nearest.
    void startApart() {
        std::mt19937_64 random(2);
        std::vector<double> nearest(mCount, std::numeric_limits<double>::infinity());
        std::size_t chosen = random() % mCount;
        mParts.vectors.clear();
        for (int c = 0; c < mParts.clusters; ++c) {
            mParts.vectors.insert(mParts.vectors.end(), vector(chosen), vector(chosen) + mSize);
            const float* mean = &mParts.vectors[static_cast<std::size_t>(c) * mSize];
            forBlocks(mCount, [&](std::size_t first, std::size_t last) {
                for (std::size_t n = first; n < last; ++n)
                    nearest[n] = std::min(nearest[n], squaredDistance(vector(n), mean, mSize));
            });
            const double total = std::accumulate(nearest.begin(), nearest.end(), 0.0);
            double place = static_cast<double>(random() >> 11) * 0x1p-53 * total;
            for (chosen = 0; chosen + 1 < mCount && place >= nearest[chosen]; ++chosen)
                place -= nearest[chosen];
        }
    }

    // From means alone to `components` components, which the present clusters give.
    void widen(int components) {
        mParts.components = components;
        update();
    }

    void improve() {
        assign();
        update();
    }

    void assign() {
        const TransferCodebook book(mParts);
        forBlocks(mCount, [&](std::size_t first, std::size_t last) {
            std::vector<float> weights(mParts.components);
            for (std::size_t n = first; n < last; ++n) {
                mOwner[n] = book.bestCluster(vector(n));
                book.weightsIn(mOwner[n], vector(n), weights.data());
                const float* mean = &mParts.vectors[mOwner[n] * (mParts.components + 1) * mSize];
                mError[n] = squaredDistance(vector(n), mean, mSize);
                for (const float w : weights) mError[n] -= static_cast<double>(w) * w;
            }
        });
        fillEmpty();
    }

    // A cluster that nothing is in takes the vector that is served worst.
    void fillEmpty() {
        std::vector<std::size_t> members(mParts.clusters, 0);
        for (const int c : mOwner) ++members[c];
        for (int c = 0; c < mParts.clusters; ++c) {
            if (members[c] > 0) continue;
            const auto worst = std::max_element(mError.begin(), mError.end()) - mError.begin();
            if (!(mError[worst] > 0)) return;
            --members[mOwner[worst]];
            ++members[c];
            mOwner[worst] = c;
            mError[worst] = 0;
        }
    }

    // Means and components of the clusters as they are; one that is empty keeps its mean.
    void update() {
        std::vector<std::vector<std::size_t>> members(mParts.clusters);
        for (std::size_t n = 0; n < mCount; ++n) members[mOwner[n]].push_back(n);
        const std::size_t before = mParts.vectors.size() / mParts.clusters;
        const std::size_t after = static_cast<std::size_t>(mParts.components + 1) * mSize;
        std::vector<float> vectors(mParts.clusters * after, 0.0f);
        parallelFor(mParts.clusters, [&](int c) {
            float* to = &vectors[c * after];
            std::copy_n(&mParts.vectors[c * before], mSize, to);
            if (!members[c].empty()) fitCluster(members[c], to);
        });
        mParts.vectors = std::move(vectors);
    }

    void fitCluster(const std::vector<std::size_t>& members, float* to) const {
        std::vector<double> mean(mSize, 0.0), offset(mSize);
        for (const std::size_t n : members)
            for (int i = 0; i < mSize; ++i) mean[i] += vector(n)[i];
        for (int i = 0; i < mSize; ++i)
            to[i] = static_cast<float>(mean[i] / static_cast<double>(members.size()));
        if (mParts.components == 0) return;
        std::vector<double> covariance(static_cast<std::size_t>(mSize) * mSize, 0.0);
        for (const std::size_t n : members) {
            for (int i = 0; i < mSize; ++i) offset[i] = static_cast<double>(vector(n)[i]) - to[i];
            for (int i = 0; i < mSize; ++i) {
                double* row = &covariance[static_cast<std::size_t>(i) * mSize];
                for (int j = 0; j < mSize; ++j) row[j] += offset[i] * offset[j];
            }
        }
        const std::vector<double> axes = principalAxes(covariance, mSize);
        for (int j = 0; j < mParts.components; ++j)
            for (int i = 0; i < mSize; ++i)
                to[(j + 1) * mSize + i] = static_cast<float>(axes[static_cast<std::size_t>(j) * mSize + i]);
    }

    std::vector<float> mVectors;
    int mSize;
    std::size_t mCount;
    Parts mParts;
    std::vector<int> mOwner;
    std::vector<double> mError;
};

// From weights as halves to bytes whose ranges hold the weights of these vectors.
TransferCodebook withBytes(const TransferCodebook& book, std::span<const float> vectors,
                           const std::vector<std::uint8_t>& clusters) {
    Parts parts = book.parts();
    const int size = parts.shape.size(), m = parts.components;
    const float most = std::numeric_limits<float>::infinity();
    std::vector<glm::vec2> ends(static_cast<std::size_t>(parts.clusters) * m, {most, -most});
    std::vector<float> weights(m);
    for (std::size_t n = 0; n < clusters.size(); ++n) {
        book.weightsIn(clusters[n], &vectors[n * size], weights.data());
        for (int j = 0; j < m; ++j) {
            glm::vec2& end = ends[clusters[n] * m + j];
            end = {std::min(end.x, weights[j]), std::max(end.y, weights[j])};
        }
    }
    parts.weights = Weights::Byte;
    for (const glm::vec2& end : ends)  // empty: no vector is in the cluster
        parts.ranges.push_back(end.x <= end.y ? glm::vec2(end.x, (end.y - end.x) / 255.0f) : glm::vec2(0.0f));
    return TransferCodebook(std::move(parts));
}

std::vector<std::uint8_t> clustersOf(const TransferCodebook& book, std::span<const float> vectors) {
    const int size = book.parts().shape.size();
    std::vector<std::uint8_t> clusters(vectors.size() / size);
    forBlocks(clusters.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            clusters[n] = static_cast<std::uint8_t>(book.bestCluster(&vectors[n * size]));
    });
    return clusters;
}

TransferCodebook halves(const TransferShape& shape) {
    Parts parts;
    parts.shape = shape;
    parts.weights = Weights::Half;
    return TransferCodebook(std::move(parts));
}

TransferCodebook trainWithHalves(const std::vector<float>& vectors, const TransferShape& shape,
                                 const TransferCompression& settings) {
    return TransferCodebook(Training(vectors, shape, settings).run(settings.components, settings.rounds));
}

}  // namespace

TransferCodebook trainCodebook(std::span<const float> vectors, const TransferShape& shape,
                               const TransferCompression& settings) {
    check(vectors, shape, settings);
    if (settings.clusters == 0) return halves(shape);
    const std::vector<float> chosen = spread(vectors, shape.size(), settings.trainingVectors);
    const TransferCodebook book = trainWithHalves(chosen, shape, settings);
    return settings.weights == Weights::Half ? book : withBytes(book, chosen, clustersOf(book, chosen));
}

CompressedTransfer compressTransfer(std::span<const float> vectors, const TransferShape& shape,
                                    const TransferCompression& settings) {
    check(vectors, shape, settings);
    TransferCompression asHalves = settings;
    asHalves.weights = Weights::Half;
    TransferCodebook book = stereonav::trainCodebook(vectors, shape, asHalves);
    const std::vector<std::uint8_t> clusters = clustersOf(book, vectors);
    if (settings.clusters > 0 && settings.weights == Weights::Byte) book = withBytes(book, vectors, clusters);
    CompressedTransfer compressed{std::move(book), {}};
    const std::size_t bytes = compressed.codebook.recordBytes();
    compressed.records.resize(clusters.size() * bytes);
    forBlocks(clusters.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            compressed.codebook.encodeIn(clusters[n], &vectors[n * shape.size()],
                                         &compressed.records[n * bytes]);
    });
    return compressed;
}

double relativeError(const CompressedTransfer& compressed, std::span<const float> vectors) {
    const int size = compressed.codebook.parts().shape.size();
    std::vector<float> decoded(size);
    double error = 0, power = 0;
    for (std::size_t n = 0; n < compressed.count(); ++n) {
        compressed.decode(n, decoded.data());
        error += squaredDistance(decoded.data(), &vectors[n * size], size);
        for (int i = 0; i < size; ++i)
            power += static_cast<double>(vectors[n * size + i]) * vectors[n * size + i];
    }
    return power > 0 ? std::sqrt(error / power) : 0;
}

}  // namespace stereonav
