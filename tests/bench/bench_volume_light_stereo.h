// Two eyes from one sweep: what they cost and how much they differ from two sweeps; and the ratios of times
// that are tracked from run to run.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>

#include "tests/bench/bench_volume_light_errors.h"
#include "tests/bench/bench_volume_light_runs.h"
#include "tests/bench/bench_volume_light_subjects.h"
#include "tests/oracle/plain_sweep.h"

namespace stereonav::bench {

// Returns slices along an axis of one eye's own, which points at the subject's middle, with that eye's rays
// of the shared sweep.
inline SweepGeometry ownGeometry(const Medium& medium, const MediumLook& look, const SweepSetting& setting,
                                 const EyeView& eye, const SweepGeometry& shared, std::size_t number) {
    EyeView turned = eye;
    turned.forward = glm::normalize(medium.bounds().center() - eye.eye);
    turned.right = glm::normalize(glm::cross(turned.forward, eye.up));
    turned.up = glm::cross(turned.right, turned.forward);
    SweepGeometry own =
        makeSweepGeometry(medium, look, setting, std::span<const EyeView>(&turned, 1), eye.head);
    own.eyes = {shared.eyes[number]};
    own.eyes[0].origin += shared.anchor - own.anchor;
    return own;
}

// Prints what an axis of each eye's own would change. The plain sweep is used, since the fast ones choose the
// axis themselves.
inline void printOwnAxes(const MediumSubject& subject) {
    constexpr int kSize = 64;
    const Medium medium = subject.medium();
    const StereoViews stereo = stereoViewsOf(medium, kSize);
    const std::array<EyeView, 2> eyes{stereo.left, stereo.right};
    for (const int slices : {64, 256}) {
        SweepSetting setting;
        setting.slices = slices;
        setting.lightSize = 128;
        const SweepGeometry shared = makeSweepGeometry(medium, subject.look, setting, eyes, stereo.left.head);
        const auto both = plainSweep(medium, subject.look, setting, shared, subject.time);
        double levels = 0, angle = 0;
        for (std::size_t n = 0; n < 2; ++n) {
            const SweepGeometry own = ownGeometry(medium, subject.look, setting, eyes[n], shared, n);
            const auto one = plainSweep(medium, subject.look, setting, own, subject.time);
            levels += 0.5 * greyLevels(one[0].light, both[n].light, subject.look.background);
            angle = std::max(angle, std::asin(glm::length(glm::cross(own.axis, shared.axis))));
        }
        std::printf(
            "\n%d slices along an axis of each eye's own, up to %.2f degrees from the shared one: %.3f "
            "grey levels from it on average.\n",
            slices, angle * 57.29578, levels);
        std::fflush(stdout);
    }
}

// Prints what both eyes in one sweep cost, and each in a sweep of its own, and how these pictures differ.
inline void printStereo(const MediumSubject& subject, int size, GpuSweepTimer& timer) {
    const Medium medium = subject.medium();
    const StereoViews stereo = stereoViewsOf(medium, size);
    const std::array<EyeView, 2> eyes{stereo.left, stereo.right};
    std::printf(
        "\n### %s, two eyes, %dx%d pixels, indirect\n\n"
        "| path | slices | one sweep processor ms | two sweeps processor ms | mean difference, grey levels | "
        "left | right |\n"
        "|---|---|---|---|---|---|---|\n",
        subject.name.c_str(), size, size);
    for (const SweepPath& path : sweepPaths(medium, timer))
        for (const int slices : {64, 256}) {
            if (!path.run) {
                std::printf("| %s | %d | no GL context here | | | | |\n", path.name.c_str(), slices);
                continue;
            }
            SweepSetting setting;
            setting.slices = slices;
            std::array<MediumPicture, 2> both;
            const SweepTime together =
                path.run(subject.look, setting, eyes, stereo.left.head, subject.time, both, 3);
            double apart = 0;
            std::array<double, 2> bytes{};
            for (std::size_t n = 0; n < 2; ++n) {
                EyeView own = eyes[n];
                own.head = own.eye;
                const OneEye one = renderOne(path, subject.look, setting, own, subject.time, 3);
                apart += one.time.processor_ms;
                bytes[n] = greyLevels(one.picture.light, both[n].light, subject.look.background);
            }
            std::printf("| %s | %d | %.1f | %.1f | %.3f | %.3f | %.3f |\n", path.name.c_str(), slices,
                        together.processor_ms, apart, 0.5 * (bytes[0] + bytes[1]), bytes[0], bytes[1]);
            std::fflush(stdout);
        }
}

struct MediumMarks {
    std::string subject;
    SweepTime unshaded, full, stereo;  // CPU
    SweepTime shaders;                 // 1e300: llvmpipe does not draw here
};

// Returns the least times of runs that take turns, so that what else the machine does touches all alike.
inline MediumMarks measureMarks(GpuSweepTimer& timer) {
    constexpr int kSize = 512, kTurns = 9;
    std::vector<MediumSubject> heads = headSubject(true);
    const MediumSubject subject = heads.empty() ? waxSubject() : heads.front();
    const Medium medium = subject.medium();
    const EyeView view = viewOf(medium, kSize);
    const StereoViews stereo = stereoViewsOf(medium, kSize);
    const std::array<EyeView, 2> eyes{stereo.left, stereo.right};
    std::array<MediumPicture, 2> pictures;
    MediumLook unshaded = subject.look;
    unshaded.model = MediumModel::Emission;
    const SweepSetting setting;
    const std::vector<SweepPath> paths = sweepPaths(medium, timer);
    MediumMarks marks;
    marks.subject = subject.name;
    for (int n = 0; n < kTurns; ++n) {
        marks.unshaded.take(renderOne(paths[0], unshaded, setting, view, subject.time, 1).time);
        marks.full.take(renderOne(paths[0], subject.look, setting, view, subject.time, 1).time);
        marks.stereo.take(
            paths[0].run(subject.look, setting, eyes, stereo.left.head, subject.time, pictures, 1));
    }
    if (timer.renderer().find("llvmpipe") != std::string::npos)
        marks.shaders = renderOne(paths[1], subject.look, setting, view, subject.time, 3).time;
    return marks;
}

inline void printMarkTimes(const MediumMarks& m) {
    std::printf("\n%s with its surfaces, 512x512, 256 slices\n\n| | ms | processor ms |\n|---|---|---|\n",
                m.subject.c_str());
    const auto line = [](const char* name, const SweepTime& t) {
        if (t.ms < 1e300) std::printf("| %s | %.1f | %.1f |\n", name, t.ms, t.processor_ms);
    };
    line("CPU, unshaded", m.unshaded);
    line("CPU, full model", m.full);
    line("CPU, full model, two eyes", m.stereo);
    line("shaders under llvmpipe, full model", m.shaders);
}

inline void printMarks(const MediumMarks& m) {
    if (m.shaders.ms < 1e300) std::printf("cpu_vs_llvmpipe %.2f\n", m.shaders.ms / m.full.ms);
    std::printf("full_vs_unshaded %.2f\n", m.full.ms / m.unshaded.ms);
    std::printf("stereo_vs_mono %.2f\n", m.stereo.ms / m.full.ms);
}

}  // namespace stereonav::bench
