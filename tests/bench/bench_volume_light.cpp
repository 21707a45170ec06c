// Volume light against the truth of the path tracer: error against time for slices, cone angles and sizes of
// the light's buffer, on the CPU and by the GPU's shaders; what both eyes in one sweep cost and change; which
// settings follow multiple scattering best. With --marks "name value" lines alone: 512x512 pixels, 256
// slices; --times prints the times that they come from too. With --shading what shading at places costs and
// saves, with --sharing what eyes that share do.
// --samples N: paths a pixel of the truth; --size N: pixels a side of what is compared with it.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "tests/bench/bench_volume_light_fit.h"
#include "tests/bench/bench_volume_light_shading.h"
#include "tests/bench/bench_volume_light_sharing.h"
#include "tests/bench/bench_volume_light_stereo.h"

namespace stereonav::bench {
namespace {

constexpr int kDirectSamples = 8;  // times as many: their paths are short

struct Options {
    bool marks = false, times = false, shading = false, sharing = false;
    int samples = 256, size = 64;
    std::string only;  // subject
};

struct Variation {
    std::string name;
    SweepSetting setting;
};

std::vector<Variation> variations(bool indirect) {
    std::vector<Variation> all;
    SweepSetting setting;
    for (const int slices : {64, 128, 256, 512, 1024}) {
        setting.slices = slices;
        all.push_back({"slices " + std::to_string(slices), setting});
    }
    setting = {};
    for (const int size : {64, 128, 256, 512}) {
        setting.lightSize = size;
        all.push_back({"light buffer " + std::to_string(size), setting});
    }
    setting = {};
    for (const double cone : {0.0, 0.3, 0.6, 1.2, 2.0}) {
        if (!indirect) break;
        setting.coneAngle = cone;
        char name[32];
        std::snprintf(name, sizeof name, "cone %.1f", cone);
        all.push_back({name, setting});
    }
    return all;
}

void printErrors(std::span<const SweepPath> paths, const MediumLook& look, const EyeView& view, double time,
                 const MediumTruth& truth) {
    std::printf(
        "\n| path | setting | ms | processor ms | RMSE linear | RMSE display | PSNR dB | light / truth |\n"
        "|---|---|---|---|---|---|---|---|\n");
    for (const SweepPath& path : paths)
        for (const Variation& v : variations(look.model == MediumModel::Indirect)) {
            if (!path.run) {
                std::printf("| %s | %s | no GL context here | | | | | |\n", path.name.c_str(),
                            v.name.c_str());
                continue;
            }
            const OneEye one = renderOne(path, look, v.setting, view, time, 2);
            const MediumError e = errorOf(truth, one.picture.light, look.background);
            const char* below = e.lost ? "< " : "";
            std::printf("| %s | %s | %.1f | %.1f | %s%.5f | %s%.5f | %s%.2f | %.3f |\n", path.name.c_str(),
                        v.name.c_str(), one.time.ms, one.time.processor_ms, below, e.linear, below, e.display,
                        e.lost ? "> " : "", e.psnr_db(), e.light);
            std::fflush(stdout);
        }
}

void printTruth(const MediumSubject& subject, const NamedWay& way, const MediumLook& look,
                const MediumTruth& truth, int samples) {
    std::printf(
        "\n### %s, light %s, %s\n\nTruth: %dx%d pixels, %d paths each, %.0f s; its own standard error: "
        "%.5f linear, %.5f display.\n",
        subject.name.c_str(), way.name.c_str(), std::string(nameOf(look.model)).c_str(), truth.one.width(),
        truth.one.height(), samples, truth.seconds, truth.linearNoise, truth.displayNoise);
    std::fflush(stdout);
}

void printShares(const Medium& medium, const MediumSubject& subject, const MediumLook& look,
                 const EyeView& view, int samples) {
    const OrderShares s = orderShares(medium, look, view, samples, subject.time);
    const glm::dvec3 back = 1.0 - s.forward, carried = s.forward - s.direct;
    std::printf(
        "\nOf the truth's light (red, green, blue) %.3f %.3f %.3f is scattered once, %.3f %.3f %.3f more "
        "than once without ever turning back, %.3f %.3f %.3f has turned back.\n\n",
        s.direct.x, s.direct.y, s.direct.z, carried.x, carried.y, carried.z, back.x, back.y, back.z);
}

// Error against the same model in many more slabs, and how fast it falls: order = log2 of the ratio.
void printOrder(const MediumSubject& subject, const EyeView& view) {
    constexpr int kFinest = 4096;
    const Medium medium = subject.medium();
    const SweepPath path = cpuPath(medium);
    std::printf(
        "\n| %s: RMSE to %d slices | 64 | 128 | 256 | 512 | 1024 | orders |\n|---|---|---|---|---|---|---|\n",
        subject.name.c_str(), kFinest);
    for (const MediumModel model : {MediumModel::Emission, MediumModel::Direct, MediumModel::Indirect}) {
        MediumLook look = subject.look;
        look.model = model;
        SweepSetting setting;
        setting.slices = kFinest;
        const OneEye finest = renderOne(path, look, setting, view, subject.time, 1);
        std::vector<double> errors;
        for (setting.slices = 64; setting.slices <= 1024; setting.slices *= 2) {
            const OneEye one = renderOne(path, look, setting, view, subject.time, 1);
            const Plane<glm::vec4>& truth = finest.picture.light;
            errors.push_back(
                std::sqrt(errorProducts(truth, truth, one.picture.light, look.background).linear));
        }
        std::printf("| %s |", std::string(nameOf(model)).c_str());
        for (const double e : errors) std::printf(" %.6f |", e);
        for (std::size_t n = 1; n < errors.size(); ++n)
            std::printf(" %.2f", std::log2(errors[n - 1] / errors[n]));
        std::printf(" |\n");
        std::fflush(stdout);
    }
}

void compareSubject(const MediumSubject& subject, const Options& options, GpuSweepTimer& timer) {
    const Medium medium = subject.medium();
    const EyeView view = viewOf(medium, options.size);
    const std::vector<SweepPath> paths = sweepPaths(medium, timer);
    const std::vector<NamedWay> ways = lightWays();
    for (const NamedWay& way : ways)
        for (const MediumModel model : {MediumModel::Direct, MediumModel::Indirect}) {
            MediumLook look = subject.look;
            look.light.direction = way.direction;
            look.model = model;
            const int samples = (model == MediumModel::Direct ? kDirectSamples : 1) * options.samples;
            const MediumTruth truth = trackTruth(medium, look, view, samples, subject.time);
            printTruth(subject, way, look, truth, samples);
            // The shaders make the same pictures, which one way of light is enough to show.
            const bool first = &way == &ways.front();
            printErrors(std::span(paths).first(first ? paths.size() : 1), look, view, subject.time, truth);
            if (model != MediumModel::Indirect) continue;
            printShares(medium, subject, look, view, std::max(1, options.samples / 8));
            printFit(subject, look, truth, view);
        }
}

int run(const Options& options) {
    if (options.shading) {
        printShading();
        return 0;
    }
    GpuSweepTimer timer;
    if (options.marks || options.times) {
        const MediumMarks marks = measureMarks(timer);
        if (options.times) printMarkTimes(marks);
        printMarks(marks);
        return 0;
    }
    if (options.sharing) {
        std::vector<MediumSubject> subjects{cloudSubject(), waxSubject()};
        for (MediumSubject& head : headSubject(true)) subjects.push_back(std::move(head));
        for (const MediumSubject& subject : subjects)
            if (options.only.empty() || subject.name == options.only) printSharing(subject);
        return 0;
    }
    std::printf("%d threads; shaders run on: %s\n", threadCount(), timer.renderer().c_str());
    for (const MediumSubject& subject : mediumSubjects()) {
        if (!options.only.empty() && subject.name != options.only) continue;
        compareSubject(subject, options, timer);
        printOrder(subject, viewOf(subject.medium(), options.size));
        printStereo(subject, 256, timer);
        printOwnAxes(subject);
    }
    const MediumMarks marks = measureMarks(timer);
    printMarkTimes(marks);
    printMarks(marks);
    return 0;
}

Options parse(int count, char** arguments) {
    Options options;
    for (int n = 1; n < count; ++n) {
        const std::string word = arguments[n];
        if (word == "--marks") options.marks = true;
        if (word == "--times") options.times = true;
        if (word == "--shading") options.shading = true;
        if (word == "--sharing") options.sharing = true;
        if (n + 1 < count && word == "--samples") options.samples = std::max(2, std::atoi(arguments[n + 1]));
        if (n + 1 < count && word == "--size") options.size = std::max(8, std::atoi(arguments[n + 1]));
        if (n + 1 < count && word == "--only") options.only = arguments[n + 1];
    }
    return options;
}

}  // namespace
}  // namespace stereonav::bench

int main(int count, char** arguments) {
    try {
        return stereonav::bench::run(stereonav::bench::parse(count, arguments));
    } catch (const stereonav::Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
