// The sweeps that are measured: on the CPU, and by the GPU's shaders where there is a GL context.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/stopwatch.h"
#include "engine/medium/medium_sweep.h"
#include "tests/bench/bench_medium_gpu.h"

namespace stereonav::bench {

// Renders all eyes in one sweep, as often as asked; returns the least time in ms.
using SweepRun =
    std::function<double(const MediumLook&, const SweepSetting&, std::span<const EyeView>,
                         const glm::dvec3& head, double time, std::span<MediumPicture>, int runs)>;

struct SweepPath {
    std::string name;
    SweepRun run;  // empty: there is none here
};

// medium must outlive it.
inline SweepPath cpuPath(const Medium& medium) {
    auto sweep = std::make_shared<MediumSweep>(medium);
    return {"CPU", [sweep](const MediumLook& look, const SweepSetting& setting, std::span<const EyeView> eyes,
                           const glm::dvec3& head, double time, std::span<MediumPicture> pictures, int runs) {
                double least = 1e300;
                for (int n = 0; n < runs; ++n) {
                    const Stopwatch watch;
                    sweep->render(look, setting, eyes, head, time, pictures);
                    least = std::min(least, watch.elapsed_ms());
                }
                return least;
            }};
}

// By the shaders, on what draws here: a GPU or Mesa's software rasteriser. One medium at a time.
inline SweepPath shaderPath(const Medium& medium, GpuSweepTimer& timer) {
    if (!timer.available()) return {"shaders", {}};
    const std::shared_ptr<GpuSweepTimer> held(&timer, [](GpuSweepTimer* t) { t->forget(); });
    const Medium* m = &medium;
    return {"shaders",
            [m, held](const MediumLook& look, const SweepSetting& setting, std::span<const EyeView> eyes,
                      const glm::dvec3&, double time, std::span<MediumPicture> pictures, int runs) {
                const GpuSweepTime took = held->time(*m, look, setting, eyes, runs, time);
                std::copy(held->pictures().begin(), held->pictures().end(), pictures.begin());
                return took.least_ms;
            }};
}

inline std::vector<SweepPath> sweepPaths(const Medium& medium, GpuSweepTimer& timer) {
    return {cpuPath(medium), shaderPath(medium, timer)};
}

struct OneEye {
    MediumPicture picture;
    double ms = 0;
};
inline OneEye renderOne(const SweepPath& path, const MediumLook& look, const SweepSetting& setting,
                        const EyeView& view, double time, int runs) {
    OneEye one;
    one.ms = path.run(look, setting, {&view, 1}, view.head, time, {&one.picture, 1}, runs);
    return one;
}

}  // namespace stereonav::bench
