// Precomputed light: how long bakes take (Wyman et al. 2006, Table 1) and what each way of choosing paths
// gains at equal error. With --marks "name value" lines alone, with --table bakes and with --frames the cost
// of frames alone. Times of whole volumes are rates measured on a random part of the texels and scaled;
// processor times, of all threads together, say what they would be on a machine that does nothing else.
#include <cstdio>
#include <cstring>
#include <functional>

#include "engine/base/error.h"
#include "engine/simd/simd_target.h"
#include "tests/bench/bench_light_gain.h"
#include "tests/bench/bench_light_lookup.h"
#include "tests/bench/bench_light_occlusion.h"
#include "tests/bench/bench_light_view.h"

namespace stereonav::bench {
namespace {

constexpr int kOrder = 5, kChannels = 1;
constexpr int kNaiveSamples = 2500;

struct Marks {
    LightSubject subject = lightSubject();
    std::vector<Brick> bricks = shuffledBricks(subject.volume.frame.size);
    double found_s = fields_s(subject.volume);

    TexelLighter lighter(const TexelSampling& sampling = {}) const {
        return TexelLighter(subject.volume, subject.volume.frame, subject.setup, sampling);
    }
    // With the fields found, which fields_s counts.
    double irradiance_s(int samples, double seconds, BakeRate* rate = nullptr) const {
        const TexelLighter light = lighter();
        irradianceRate(light, bricks, 1, 1.5);
        const BakeRate r = irradianceRate(light, bricks, samples, seconds);
        if (rate) *rate = r;
        return found_s + r.all_s;
    }
    double transfer_s(int samples, double seconds, BakeRate* rate = nullptr) const {
        const TexelLighter light = lighter();
        irradianceRate(light, bricks, 1, 1.5);
        const BakeRate r = transferRate(light, bricks, samples, kOrder, kChannels, seconds);
        if (rate) *rate = r;
        return found_s + r.all_s;
    }
    std::vector<Brick> someBricks(std::size_t count) const {
        return {bricks.begin(), bricks.begin() + static_cast<std::ptrdiff_t>(std::min(count, bricks.size()))};
    }
    // Processor time of naive sampling for that of ours at the error that it reaches with kNaiveSamples. Both
    // leap: the difference is the sampling alone.
    double equalErrorSpeedup() const {
        const std::vector<Brick> some = someBricks(12);
        TexelSampling naive;
        naive.naive = true;
        const GainPoint slow = measureError(subject, naive, some, kNaiveSamples / 10, 8);
        std::vector<GainPoint> ours;
        for (const int samples : {1, 2, 4, 8, 16, 32})
            ours.push_back(measureError(subject, {}, some, samples, 8));
        return 10 * slow.processor_s / timeFor(slow.error / std::sqrt(10.0), ours);
    }
};

// Prints the paper's Table 1, from rates of `seconds` each.
void printBakes(const Marks& marks) {
    constexpr double kSeconds = 20;
    const OneView view = viewOf900(marks.subject);
    const std::vector<Brick> all = inSmallPieces(marks.bricks);
    const TexelLighter light = marks.lighter();
    irradianceRate(light, all, 1, 1.5);  // finds what rays leap by
    std::printf("one view of 900x900: %zu texels, %zu pixels on the surface\n", view.texelCount,
                view.pixelCount);
    std::printf("%-34s %8s %10s %10s %22s %10s\n", "", "samples", "minutes", "processor",
                "M samples/s a thread", "measured");
    const auto row = [&](const char* name, double before_s, const auto& rateOf) {
        for (const int samples : {100, 625, 2500, 10000}) {
            const BakeRate rate = rateOf(samples);
            std::printf("%-34s %8d %10.2f %10.2f %22.3f %9.1f%%\n", name, samples,
                        (before_s + rate.all_s) / 60, rate.processor_s / 60, rate.samples_s / 1e6,
                        100 * rate.part);
            std::fflush(stdout);
        }
    };
    const auto irradiance = [&](const std::vector<Brick>& bricks) {
        return [&](int samples) { return irradianceRate(light, bricks, samples, kSeconds); };
    };
    const auto transfer = [&](const std::vector<Brick>& bricks) {
        return [&](int samples) { return transferRate(light, bricks, samples, kOrder, kChannels, kSeconds); };
    };
    row("transfer, of one view", 0, transfer(view.texels));
    row("transfer, all", marks.found_s, transfer(all));
    row("irradiance, of one view", 0, irradiance(view.texels));
    row("irradiance, all", marks.found_s, irradiance(all));
    row("paths from pixels, of one view", 0,
        [&](int samples) { return pointRate(light, view.pixels, samples, kSeconds); });
}

void printGains(const Marks& marks) {
    const std::vector<Brick> some = marks.someBricks(12);
    std::printf("\n%-26s %10s %10s %10s   times of naive sampling for the error of 250 of its samples\n",
                "sampling", "error 16", "error 64", "error 256");
    double naive = 0;
    double target = 0;
    for (const NamedSampling& s : samplings()) {
        std::vector<GainPoint> points;
        for (const int samples : {1, 4, 16, 64, 256})
            points.push_back(measureError(marks.subject, s.sampling, some, samples, 8));
        if (naive == 0) {
            naive = points[4].processor_s * 250 / 256;
            target = points[4].error * std::sqrt(256.0 / 250);
        }
        std::printf("%-26s %10.5f %10.5f %10.5f   %.1f\n", s.name.c_str(), points[2].error, points[3].error,
                    points[4].error, naive / timeFor(target, points));
    }
}

enum class Part { All, Marks, Frames, Table };

// Which kernels and how many threads the numbers below are of.
void printMachine() {
    std::printf("instruction_set %s\n", nameOf(availableTarget(SimdTarget::Auto)).data());
    std::printf("threads %d\n", threadCount());
}

int run(Part part) {
    printMachine();
    if (part == Part::Frames) {
        printLookup(measureLookup(lightSubject(), kOrder, 100), false);
        return 0;
    }
    const Marks marks;
    if (part == Part::Marks) {
        BakeRate rate;
        std::printf("irradiance100_s %.1f\n", marks.irradiance_s(100, 8, &rate));
        std::printf("irradiance100_processor_s %.1f\n", rate.processor_s);
        std::printf("transfer100_s %.1f\n", marks.transfer_s(100, 7, &rate));
        std::printf("transfer100_processor_s %.1f\n", rate.processor_s);
        std::printf("equal_error_speedup %.1f\n", marks.equalErrorSpeedup());
        printLookup(measureLookup(marks.subject, kOrder, 40), true);
        printOcclusionMarks();
        return 0;
    }
    std::printf("%s, %d bounces, %d threads, fields of all isovalues found in %.2f s\n",
                marks.subject.name.c_str(), marks.subject.setup.bounces, threadCount(), marks.found_s);
    printBakes(marks);
    if (part == Part::Table) return 0;
    printGains(marks);
    printLookup(measureLookup(marks.subject, kOrder, 40), false);
    return 0;
}

}  // namespace
}  // namespace stereonav::bench

int main(int count, char** arguments) {
    try {
        using stereonav::bench::Part;
        const auto asks = [&](const char* option) {
            return count > 1 && std::strcmp(arguments[1], option) == 0;
        };
        return stereonav::bench::run(asks("--marks")    ? Part::Marks
                                     : asks("--frames") ? Part::Frames
                                     : asks("--table")  ? Part::Table
                                                        : Part::All);
    } catch (const stereonav::Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
