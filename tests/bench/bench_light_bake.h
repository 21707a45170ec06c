// Times of baking all texels of a volume, from a random part of them: bricks of 8^3 texels, as a bake hands
// them out, on all threads. What is built once is timed apart and not scaled.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/light/isovalue_field.h"
#include "engine/light/spherical_harmonics.h"
#include "engine/light/texel_light.h"
#include "tests/bench/bench_light_subject.h"

namespace stereonav::bench {

using Brick = std::vector<glm::ivec3>;

// All bricks in a random order.
inline std::vector<Brick> shuffledBricks(const glm::ivec3& size, unsigned seed = 1) {
    std::vector<Brick> bricks;
    for (int k = 0; k < size.z; k += 8)
        for (int j = 0; j < size.y; j += 8)
            for (int i = 0; i < size.x; i += 8) {
                Brick brick;
                const glm::ivec3 end = glm::min(glm::ivec3(i, j, k) + 8, size);
                for (int z = k; z < end.z; ++z)
                    for (int y = j; y < end.y; ++y)
                        for (int x = i; x < end.x; ++x) brick.push_back({x, y, z});
                bricks.push_back(std::move(brick));
            }
    std::shuffle(bricks.begin(), bricks.end(), std::mt19937(seed));
    return bricks;
}

// Processor time of all threads so far: what a busy machine does not change much.
inline double processor_s() {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return static_cast<double>(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}

// Seconds to find the fields of all isovalues.
inline double fields_s(const GreyVolume& volume) {
    const Stopwatch watch;
    const IsovalueFields fields(volume, true);
    parallelFor(fields.rungs(), [&](int n) { fields.field(n); });
    return watch.elapsed_ms() / 1000;
}

struct BakeRate {
    double all_s = 0;        // for all texels
    double part = 0;         // share of the texels that was measured
    double texels = 0;       // of them, per second, those without a surface included
    double onSurface = 0;    // share
    double processor_s = 0;  // for all texels, of all threads together
    double samples_s = 0;    // a second, of texels on a surface
};

// Calls job(brick), which gives the number of texels on a surface, for bricks (or pixels) in turn until
// `seconds` are over.
template <typename Piece, typename Job>
BakeRate bakeRate(const std::vector<Piece>& bricks, double seconds, int samples, const Job& job) {
    std::atomic<std::size_t> next{0}, done{0}, lit{0};
    std::size_t all = 0;
    for (const Piece& b : bricks) all += b.size();
    const Stopwatch watch;
    const double before = processor_s();
    parallelFor(threadCount(), [&](int) {
        while (watch.elapsed_ms() < 1000 * seconds) {
            const std::size_t n = next++;
            if (n >= bricks.size()) return;
            lit += job(bricks[n]);
            done += bricks[n].size();
        }
    });
    const double took = watch.elapsed_ms() / 1000;
    BakeRate rate;
    const double used = processor_s() - before;
    rate.part = static_cast<double>(done) / static_cast<double>(all);
    rate.processor_s = used / rate.part;
    rate.texels = static_cast<double>(done) / took;
    rate.all_s = static_cast<double>(all) / rate.texels;
    rate.onSurface = static_cast<double>(lit) / static_cast<double>(done);
    rate.samples_s = static_cast<double>(lit) * samples / used;
    return rate;
}

inline BakeRate irradianceRate(const TexelLighter& lighter, const std::vector<Brick>& bricks, int samples,
                               double seconds) {
    return bakeRate(bricks, seconds, samples, [&](const Brick& brick) {
        std::vector<TexelSum> sums(brick.size());
        lighter.addIrradiance(brick, samples, sums);
        return static_cast<std::size_t>(
            std::count_if(sums.begin(), sums.end(), [](const TexelSum& s) { return s.samples > 0; }));
    });
}

inline BakeRate transferRate(const TexelLighter& lighter, const std::vector<Brick>& bricks, int samples,
                             int order, int channels, double seconds) {
    return bakeRate(bricks, seconds, samples, [&](const Brick& brick) {
        std::vector<float> sums(brick.size() * static_cast<std::size_t>(harmonicsCount(order) * channels));
        std::vector<std::uint8_t> alive(brick.size());
        lighter.addTransfer(brick, 0, samples, order, channels, sums, alive);
        return static_cast<std::size_t>(std::count(alive.begin(), alive.end(), std::uint8_t{1}));
    });
}

}  // namespace stereonav::bench
