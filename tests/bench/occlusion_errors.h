// How far the estimates of openness are from ray-traced obscurance, on random texels around a shown surface:
// root mean square error and Spearman's rank correlation.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "engine/light/occlusion/occlusion_rays.h"
#include "engine/light/transfer/bake_texels.h"

namespace stereonav::bench {

using Numbers = std::vector<double>;

// Ranks, equal values sharing the mean of theirs.
inline Numbers ranksOf(const Numbers& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    Numbers ranks(values.size());
    for (std::size_t first = 0, end; first < order.size(); first = end) {
        for (end = first + 1; end < order.size() && values[order[end]] == values[order[first]];) ++end;
        for (std::size_t n = first; n < end; ++n)
            ranks[order[n]] = 0.5 * static_cast<double>(first + end - 1);
    }
    return ranks;
}

// 0 where one of them is constant.
inline double correlation(const Numbers& a, const Numbers& b) {
    const auto count = static_cast<double>(a.size());
    const double meanA = std::accumulate(a.begin(), a.end(), 0.0) / count;
    const double meanB = std::accumulate(b.begin(), b.end(), 0.0) / count;
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t n = 0; n < a.size(); ++n) {
        ab += (a[n] - meanA) * (b[n] - meanB);
        aa += (a[n] - meanA) * (a[n] - meanA);
        bb += (b[n] - meanB) * (b[n] - meanB);
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0.0;
}

inline double rankCorrelation(const Numbers& a, const Numbers& b) {
    return correlation(ranksOf(a), ranksOf(b));
}

// Returns the root mean square of min(k a, 1) - b.
inline double rootMeanSquare(const Numbers& a, double k, const Numbers& b) {
    double sum = 0;
    for (std::size_t n = 0; n < a.size(); ++n) {
        const double off = std::min(k * a[n], 1.0) - b[n];
        sum += off * off;
    }
    return std::sqrt(sum / static_cast<double>(a.size()));
}

// The k in 0..4 with the least of it: eq. 5 leaves it to the user.
inline double bestGain(const Numbers& a, const Numbers& b) {
    double best = 0;
    for (int n = 1; n <= 400; ++n)
        if (rootMeanSquare(a, n / 100.0, b) < rootMeanSquare(a, best, b)) best = n / 100.0;
    return best;
}

// Texels that a lookup at the surface of an isovalue can ask for, at random.
inline std::vector<glm::ivec3> surfaceTexels(const GreyVolume& volume, double isovalue, std::size_t most) {
    TexelChoice surface;
    surface.lowest = surface.highest = static_cast<float>((isovalue - volume.offset) / volume.scale);
    Progress progress;
    const TexelLayout layout(volume.frame.size);
    std::vector<glm::ivec3> texels;
    for (const TexelBrick& brick : wantedBricks(volume, volume.frame, surface, progress))
        for (const glm::ivec3& texel : texelsIn(layout, brick)) texels.push_back(texel);
    std::shuffle(texels.begin(), texels.end(), std::mt19937(1));
    texels.resize(std::min(texels.size(), most));
    return texels;
}

}  // namespace stereonav::bench
