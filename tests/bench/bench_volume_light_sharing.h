// What it costs and saves that the right eye reads what the left one saw: by how wide pixels are beside the
// finest detail of the medium.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/medium/sweep/sweep_sharing.h"
#include "tests/bench/bench_volume_light_errors.h"
#include "tests/bench/bench_volume_light_runs.h"
#include "tests/bench/bench_volume_light_subjects.h"

namespace stereonav::bench {

// Returns the pixels a side for which one pixel is `width` times as wide as the finest detail, at the
// subject's middle.
inline int sizeForWidth(const Medium& medium, double width) {
    const StereoViews stereo = stereoViewsOf(medium, 64);
    const double depth = glm::dot(medium.bounds().center() - stereo.right.eye, stereo.right.forward);
    const double across = stereo.right.pixelWidth() * 64 * depth;
    return static_cast<int>(std::lround(across / (width * finestDetail(medium))));
}

inline double displayPsnr(const Plane<glm::vec4>& one, const Plane<glm::vec4>& two,
                          const glm::vec3& background) {
    double sum = 0;
    for (int y = 0; y < one.height(); ++y)
        for (int x = 0; x < one.width(); ++x) {
            const glm::dvec3 d(shown(one.at(x, y), background) - shown(two.at(x, y), background));
            sum += glm::dot(d, d);
        }
    return -10 * std::log10(std::max(sum / (3.0 * one.width() * one.height()), 1e-12));
}

inline void printSharing(const MediumSubject& subject) {
    constexpr int kMostSize = 1024, kTurns = 5;
    const Medium medium = subject.medium();
    std::printf(
        "\n### %s, two eyes, 256 slices\n\n"
        "| pixel / finest detail | pixels a side | own samples, processor ms | shared | one eye | two / one, "
        "own | two / one, shared | right eye: mean, grey levels | PSNR dB | left eye: mean |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n",
        subject.name.c_str());
    const SweepPath path = cpuPath(medium);
    SweepSetting own, shared;
    own.sharedWidth = 0;
    shared.sharedWidth = std::numeric_limits<double>::infinity();
    for (const double width : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        const int size = sizeForWidth(medium, width);
        if (size > kMostSize || size < 16) continue;
        const StereoViews stereo = stereoViewsOf(medium, size);
        const std::array<EyeView, 2> eyes{stereo.left, stereo.right};
        std::array<MediumPicture, 2> truth, picture;
        SweepTime ofOwn, ofShared, ofOne;
        for (int turn = 0; turn < kTurns; ++turn) {
            ofOwn.take(path.run(subject.look, own, eyes, stereo.left.head, subject.time, truth, 1));
            ofShared.take(path.run(subject.look, shared, eyes, stereo.left.head, subject.time, picture, 1));
            ofOne.take(renderOne(path, subject.look, own, stereo.left, subject.time, 1).time);
        }
        double levels[2], psnr = 0;
        for (std::size_t n = 0; n < 2; ++n)
            levels[n] = greyLevels(picture[n].light, truth[n].light, subject.look.background);
        psnr = displayPsnr(picture[1].light, truth[1].light, subject.look.background);
        std::printf("| %g | %d | %.1f | %.1f | %.1f | %.2f | %.2f | %.3f | %.1f | %.6f |\n", width, size,
                    ofOwn.processor_ms, ofShared.processor_ms, ofOne.processor_ms,
                    ofOwn.processor_ms / ofOne.processor_ms, ofShared.processor_ms / ofOne.processor_ms,
                    levels[1], psnr, levels[0]);
        std::fflush(stdout);
    }
}

}  // namespace stereonav::bench
