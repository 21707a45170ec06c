// The sweeps that are measured: on the CPU, and by the GPU's shaders where there is a GL context.
#pragma once

#include <algorithm>
#include <ctime>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/stopwatch.h"
#include "engine/medium/sweep/medium_sweep.h"
#include "tests/bench/bench_medium_gpu.h"

namespace stereonav::bench {

// The least of several runs.
struct SweepTime {
    double ms = 1e300;            // by the clock
    double processor_ms = 1e300;  // time of all threads together: what else the machine does counts less
    void take(const SweepTime& other) {
        ms = std::min(ms, other.ms);
        processor_ms = std::min(processor_ms, other.processor_ms);
    }
};

// Renders all eyes in one sweep, as often as asked.
using SweepRun =
    std::function<SweepTime(const MediumLook&, const SweepSetting&, std::span<const EyeView>,
                            const glm::dvec3& head, double time, std::span<MediumPicture>, int runs)>;

struct SweepPath {
    std::string name;
    SweepRun run;  // empty: there is none here
};

// medium must outlive the result.
inline SweepPath cpuPath(const Medium& medium) {
    auto sweep = std::make_shared<MediumSweep>(medium);
    return {"CPU", [sweep](const MediumLook& look, const SweepSetting& setting, std::span<const EyeView> eyes,
                           const glm::dvec3& head, double time, std::span<MediumPicture> pictures, int runs) {
                SweepTime least;
                for (int n = 0; n < runs; ++n) {
                    const Stopwatch watch;
                    const std::clock_t before = std::clock();
                    sweep->render(look, setting, eyes, head, time, pictures);
                    least.take({watch.elapsed_ms(),
                                1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC});
                }
                return least;
            }};
}

// Sweeps by the shaders, on what draws here: a GPU or Mesa's software rasteriser. One medium at a time.
inline SweepPath shaderPath(const Medium& medium, GpuSweepTimer& timer) {
    if (!timer.available()) return {"shaders", {}};
    const std::shared_ptr<GpuSweepTimer> held(&timer, [](GpuSweepTimer* t) { t->forget(); });
    const Medium* m = &medium;
    return {"shaders",
            [m, held](const MediumLook& look, const SweepSetting& setting, std::span<const EyeView> eyes,
                      const glm::dvec3&, double time, std::span<MediumPicture> pictures, int runs) {
                const GpuSweepTime took = held->time(*m, look, setting, eyes, runs, time);
                std::copy(held->pictures().begin(), held->pictures().end(), pictures.begin());
                return SweepTime{took.least_ms, took.processor_ms};
            }};
}

inline std::vector<SweepPath> sweepPaths(const Medium& medium, GpuSweepTimer& timer) {
    return {cpuPath(medium), shaderPath(medium, timer)};
}

struct OneEye {
    MediumPicture picture;
    SweepTime time;
};
inline OneEye renderOne(const SweepPath& path, const MediumLook& look, const SweepSetting& setting,
                        const EyeView& view, double time, int runs) {
    OneEye one;
    one.time = path.run(look, setting, {&view, 1}, view.head, time, {&one.picture, 1}, runs);
    return one;
}

}  // namespace stereonav::bench
