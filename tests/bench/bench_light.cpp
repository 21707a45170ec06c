// What each choice of paths of precomputed light gains at equal error, on the engine of Wyman et al. 2006, by
// processor time of all threads. With --marks one line "name value": what all of them gain. Their tables of
// bakes and frames are those of `stereonav report --papers --parts papers-light`.
// The error is the root of the mean squared difference, over texels, of luminance from its expectation,
// measured between runs with different seeds.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "app/report/papers/data.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/light/bake/bake_rate.h"
#include "engine/math/luminance.h"
#include "engine/simd/simd_target.h"

namespace stereonav::bench {
namespace {

constexpr int kNaiveSamples = 2500;

struct GainPoint {
    int samples = 0;
    double error = 0;        // RMS
    double processor_s = 0;  // for one run over the texels
};

// One run: luminances of all texels on a surface, in order.
std::vector<double> bakeOnce(const TexelLighter& lighter, const std::vector<TexelPiece>& bricks,
                             int samples) {
    std::vector<std::vector<TexelSum>> sums(bricks.size());
    parallelFor(static_cast<int>(bricks.size()), [&](int n) {
        const TexelPiece& brick = bricks[static_cast<std::size_t>(n)];
        auto& sum = sums[static_cast<std::size_t>(n)];
        sum.resize(brick.size());
        lighter.addIrradiance(brick, samples, sum);
    });
    std::vector<double> light;
    for (const auto& brick : sums)
        for (const TexelSum& sum : brick)
            if (sum.samples > 0) light.push_back(luminance(glm::dvec3(sum.mean)));
    return light;
}

GainPoint measureError(const PaperEngine& subject, TexelSampling sampling,
                       const std::vector<TexelPiece>& bricks, int samples, int runs) {
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

std::vector<NamedSampling> samplings() {
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
double timeFor(double error, const std::vector<GainPoint>& points) {
    for (std::size_t n = 0; n + 1 < points.size(); ++n) {
        const GainPoint &a = points[n], &b = points[n + 1];
        if (error > a.error || error < b.error) continue;
        const double share = std::log(a.error / error) / std::log(a.error / b.error);
        return a.processor_s * std::pow(b.processor_s / a.processor_s, share);
    }
    const GainPoint& last = error > points.front().error ? points.front() : points.back();
    return last.processor_s * std::pow(last.error / error, 2);  // the error falls as with independent samples
}

struct Subject {
    PaperEngine engine = paperEngine(PaperData(""));
    std::vector<TexelPiece> bricks = shuffledBricks(engine.volume.frame.size);

    Subject() { bricks.resize(std::min<std::size_t>(bricks.size(), 12)); }
    GainPoint errorOf(const TexelSampling& sampling, int samples) const {
        return measureError(engine, sampling, bricks, samples, 8);
    }
};

// Processor time of naive sampling for that of ours at the error that it reaches with kNaiveSamples. Both
// leap: the difference is the sampling alone.
double equalErrorSpeedup(const Subject& subject) {
    TexelSampling naive;
    naive.naive = true;
    const GainPoint slow = subject.errorOf(naive, kNaiveSamples / 10);
    std::vector<GainPoint> ours;
    for (const int samples : {1, 2, 4, 8, 16, 32}) ours.push_back(subject.errorOf({}, samples));
    return 10 * slow.processor_s / timeFor(slow.error / std::sqrt(10.0), ours);
}

void printGains(const Subject& subject) {
    std::printf("\n%-26s %10s %10s %10s   times of naive sampling for the error of 250 of its samples\n",
                "sampling", "error 16", "error 64", "error 256");
    double naive = 0;
    double target = 0;
    for (const NamedSampling& s : samplings()) {
        std::vector<GainPoint> points;
        for (const int samples : {1, 4, 16, 64, 256}) points.push_back(subject.errorOf(s.sampling, samples));
        if (naive == 0) {
            naive = points[4].processor_s * 250 / 256;
            target = points[4].error * std::sqrt(256.0 / 250);
        }
        std::printf("%-26s %10.5f %10.5f %10.5f   %.1f\n", s.name.c_str(), points[2].error, points[3].error,
                    points[4].error, naive / timeFor(target, points));
    }
}

int run(bool marks) {
    std::printf("instruction_set %s\nthreads %d\n", nameOf(availableTarget(SimdTarget::Auto)).data(),
                threadCount());
    const Subject subject;
    if (!marks) {
        std::printf("%s, %d bounces\n", subject.engine.title.c_str(), subject.engine.setup.bounces);
        printGains(subject);
    }
    std::printf("equal_error_speedup %.1f\n", equalErrorSpeedup(subject));
    return 0;
}

}  // namespace
}  // namespace stereonav::bench

int main(int count, char** arguments) {
    try {
        return stereonav::bench::run(count > 1 && std::strcmp(arguments[1], "--marks") == 0);
    } catch (const stereonav::Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
