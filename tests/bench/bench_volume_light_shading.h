// What shading surfaces at places and between them costs and saves, by how far apart the places lie: against
// shading at each sample.
#pragma once

#include <cstdio>

#include "tests/bench/bench_volume_light_errors.h"
#include "tests/bench/bench_volume_light_runs.h"
#include "tests/bench/bench_volume_light_subjects.h"

namespace stereonav::bench {

// The wax is polished, which its file does not say.
inline std::vector<MediumSubject> shadedSubjects() {
    std::vector<MediumSubject> subjects = headSubject(true);
    const MediumTransfer polished =
        withoutSurface(findMediumTransfer("wax"), [](MediumMaterial& m) { m.surface = 1; });
    subjects.push_back({"wax", makeWaxField(), polished, {}, waxSubject().look, 0});
    return subjects;
}

// Widths take turns, so that what else the machine does touches all alike.
inline void printShadingOf(const MediumSubject& subject, int size, const std::vector<double>& widths) {
    constexpr int kTurns = 7;
    const Medium medium = subject.medium();
    const EyeView view = viewOf(medium, size);
    const SweepPath path = cpuPath(medium);
    std::vector<OneEye> ones(widths.size());
    for (int turn = 0; turn < kTurns; ++turn)
        for (std::size_t n = 0; n < widths.size(); ++n) {
            SweepSetting setting;
            setting.shadingWidth = widths[n];
            const SweepTime before = ones[n].time;
            ones[n] = renderOne(path, subject.look, setting, view, subject.time, 1);
            ones[n].time.take(before);
        }
    const Plane<glm::vec4>& truth = ones[0].picture.light;
    for (std::size_t n = 0; n < widths.size(); ++n) {
        const ErrorProducts e = errorProducts(truth, truth, ones[n].picture.light, subject.look.background);
        double worst = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                for (int k = 0; k < 3; ++k)
                    worst = std::max<double>(worst,
                                             std::abs(truth.at(x, y)[k] - ones[n].picture.light.at(x, y)[k]));
        std::printf("| %s | %d | %g | %.1f | %.6f | %.5f |", subject.name.c_str(), size, widths[n],
                    ones[n].time.processor_ms, std::sqrt(e.linear), worst);
        if (e.display > 0)
            std::printf(" %.1f |\n", -10 * std::log10(e.display));
        else
            std::printf(" the same |\n");
        std::fflush(stdout);
    }
}

inline void printShading() {
    std::printf(
        "\n| subject | pixels a side | shading width, voxels | processor ms | RMSE linear | worst linear | "
        "PSNR dB |\n|---|---|---|---|---|---|---|\n");
    for (const MediumSubject& subject : shadedSubjects())
        for (const int size : {64, 128, 256, 512, 1024})
            printShadingOf(subject, size, {0, 0.25, 0.5, 1, 2, 4});
}

}  // namespace stereonav::bench
