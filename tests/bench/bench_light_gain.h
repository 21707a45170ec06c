// What each way of choosing paths gains: the error of texels at a number of samples, and the time for it. The
// error is the root of the mean squared difference, over texels, of luminance from its expectation, measured
// between runs with different seeds.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "tests/bench/bench_light_bake.h"

namespace stereonav::bench {

struct GainPoint {
    int samples = 0;
    double error = 0;        // RMS
    double processor_s = 0;  // for one run over the texels
};

inline double luminanceOf(const glm::vec3& c) {
    return 0.2126 * static_cast<double>(c.x) + 0.7152 * static_cast<double>(c.y) +
           0.0722 * static_cast<double>(c.z);
}

// One run: luminances of all texels on a surface, in order.
inline std::vector<double> bakeOnce(const TexelLighter& lighter, const std::vector<Brick>& bricks,
                                    int samples) {
    std::vector<std::vector<TexelSum>> sums(bricks.size());
    parallelFor(static_cast<int>(bricks.size()), [&](int n) {
        const Brick& brick = bricks[static_cast<std::size_t>(n)];
        auto& sum = sums[static_cast<std::size_t>(n)];
        sum.resize(brick.size());
        lighter.addIrradiance(brick, samples, sum);
    });
    std::vector<double> light;
    for (const auto& brick : sums)
        for (const TexelSum& sum : brick)
            if (sum.samples > 0) light.push_back(luminanceOf(sum.mean));
    return light;
}

inline GainPoint measureError(const LightSubject& subject, TexelSampling sampling,
                              const std::vector<Brick>& bricks, int samples, int runs) {
    std::vector<double> sum, squares;
    GainPoint point;
    point.samples = samples;
    point.processor_s = 1e300;
    for (int run = 0; run < runs; ++run) {
        sampling.seed = static_cast<std::uint64_t>(100 + run);
        const TexelLighter lighter(subject.volume, subject.volume.frame, subject.setup, sampling);
        bakeOnce(lighter, bricks, 1);  // finds the fields
        const double before = processorSeconds();
        const std::vector<double> light = bakeOnce(lighter, bricks, samples);
        point.processor_s = std::min(point.processor_s, processorSeconds() - before);
        sum.resize(light.size());
        squares.resize(light.size());
        for (std::size_t n = 0; n < light.size(); ++n) {
            sum[n] += light[n];
            squares[n] += light[n] * light[n];
        }
    }
    double total = 0;
    for (std::size_t n = 0; n < sum.size(); ++n)
        total += std::max(0.0, (squares[n] - sum[n] * sum[n] / runs) / (runs - 1));
    point.error = std::sqrt(total / static_cast<double>(std::max<std::size_t>(sum.size(), 1)));
    return point;
}

struct NamedSampling {
    std::string name;
    TexelSampling sampling;
};

inline std::vector<NamedSampling> samplings() {
    TexelSampling all, naive;
    naive.naive = true;
    std::vector<NamedSampling> list{{"naive", naive}, {"all", all}};
    const auto without = [&](const char* name, bool TexelSampling::*what) {
        TexelSampling some = all;
        some.*what = false;
        list.push_back({std::string("all but ") + name, some});
    };
    without("low discrepancy", &TexelSampling::lowDiscrepancy);
    without("cosine", &TexelSampling::cosine);
    without("next event", &TexelSampling::nextEvent);
    without("roulette", &TexelSampling::roulette);
    without("leaping", &TexelSampling::leaping);
    return list;
}

// The time at which a way of sampling reaches an error, from measured points: between them by powers.
inline double timeFor(double error, const std::vector<GainPoint>& points) {
    for (std::size_t n = 0; n + 1 < points.size(); ++n) {
        const GainPoint &a = points[n], &b = points[n + 1];
        if (error > a.error || error < b.error) continue;
        const double share = std::log(a.error / error) / std::log(a.error / b.error);
        return a.processor_s * std::pow(b.processor_s / a.processor_s, share);
    }
    const GainPoint& last = error > points.front().error ? points.front() : points.back();
    return last.processor_s * std::pow(last.error / error, 2);  // as for independent samples
}

}  // namespace stereonav::bench
