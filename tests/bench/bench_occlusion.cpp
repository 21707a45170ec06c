// Ambient occlusion by distribution as Ruiz et al. 2010 measure it: times by radius and method on a volume of
// their size (their Table 1; R6), and how far every method is from ray-traced obscurance on real data (R4).
// --times, --errors: one of them. --marks: two lines "name value".
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include "app/report/papers/data.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/light/occlusion/occlusion.h"
#include "tests/bench/occlusion_errors.h"
#include "tests/bench/occlusion_shapes.h"

using namespace stereonav;

namespace {

GreyVolume volumeOf(const char* name) {
    return paperVolume(PaperData(""), name, name).volume;
}

// Returns an empty volume where the file is not there.
GreyVolume foundVolume(const char* name) {
    return PaperData("").find(name).empty() ? GreyVolume() : volumeOf(name);
}

// The size of Ruiz et al.'s CT-body.
GreyVolume occlusionBody() {
    return resizedTo(volumeOf("ct/trunk_ct_3mm.nii.gz"), {256, 256, 415});
}

// Least of some runs.
template <typename Body>
double leastTime_ms(int runs, const Body& body) {
    double least = 1e30;
    for (int n = 0; n < runs; ++n) {
        const Stopwatch watch;
        body();
        least = std::min(least, watch.elapsed_ms());
    }
    return least;
}

double opennessTime_ms(const GreyVolume& volume, OcclusionMethod method, int radius, int runs = 5) {
    Progress progress;
    return leastTime_ms(runs, [&] { estimateOpenness(volume, method, glm::ivec3(radius), progress); });
}

// "name value" lines: R1 at the radius that takes longest, and its time at radius 40 over that at radius 5;
// least of some rounds, the radii taken in turn so that what else the machine does meets all of them.
void printOcclusionMarks() {
    const GreyVolume body = occlusionBody();
    constexpr std::array kRadii{1, 5, 10, 40, 64};
    std::array<double, kRadii.size()> least{};
    least.fill(1e30);
    for (int round = 0; round < 7; ++round)
        for (std::size_t n = 0; n < kRadii.size(); ++n)
            least[n] =
                std::min(least[n], opennessTime_ms(body, OcclusionMethod::Reconstructed, kRadii[n], 1));
    std::printf("ao_r1_ms %.1f\nao_radius_ratio %.3f\n", *std::max_element(least.begin(), least.end()),
                least[3] / least[1]);
}

void printTimes() {
    const GreyVolume body = occlusionBody();
    std::printf("%dx%dx%d voxels, %d threads; ms, least of 5\n", body.frame.size.x, body.frame.size.y,
                body.frame.size.z, threadCount());
    std::printf("radius  Chebyshev  CDF rec.  drawn in  Gaussian  variance\n");
    for (const int radius : {1, 2, 5, 10, 20, 40, 64}) {
        Progress progress;
        const double variance =
            leastTime_ms(5, [&] { varianceModulation(body, glm::ivec3(radius), 300, progress); });
        std::printf("%6d  %9.1f  %8.1f  %8.1f  %8.1f  %8.1f\n", radius,
                    opennessTime_ms(body, OcclusionMethod::Chebyshev, radius),
                    opennessTime_ms(body, OcclusionMethod::Reconstructed, radius),
                    opennessTime_ms(body, OcclusionMethod::DrawnIn, radius),
                    opennessTime_ms(body, OcclusionMethod::Gaussian, radius), variance);
    }
    Progress progress;
    const OpennessVolume openness =
        estimateOpenness(body, OcclusionMethod::Reconstructed, glm::ivec3(10), progress);
    std::printf("gradient of the openness by regression: %.1f\n",
                leastTime_ms(3, [&] { gradientModulation(openness, 0.1); }));
    const GreyVolume part = resizedTo(body, {64, 64, 64});
    const double radius = 10 * std::min({part.frame.spacing.x, part.frame.spacing.y, part.frame.spacing.z});
    std::printf(
        "vicinity, 42 directions, radius 10, %zu voxels: %.0f\n", part.values.size(),
        leastTime_ms(1, [&] { opennessByDirections(part, DirectionMethod::Vicinity, radius, progress); }));
}

struct Sample {
    TracedOpenness truth;
    double vicinity = 0, obscurance42 = 0;
    bench::BoxNumbers box;
};

void printRow(const char* name, const bench::Numbers& values, const std::vector<Sample>& samples) {
    bench::Numbers obscurance, visible, sphere;
    for (const Sample& s : samples) {
        obscurance.push_back(s.truth.obscurance);
        visible.push_back(s.truth.visible);
        sphere.push_back(s.truth.sphere);
    }
    const double gain = bench::bestGain(values, obscurance);
    std::printf("  %-22s %6.3f %6.3f %6.3f (k %4.2f)   %6.3f %6.3f %6.3f\n", name,
                bench::rootMeanSquare(values, 1, obscurance), bench::rootMeanSquare(values, 2, obscurance),
                bench::rootMeanSquare(values, gain, obscurance), gain,
                bench::rankCorrelation(values, obscurance), bench::rankCorrelation(values, visible),
                bench::rankCorrelation(values, sphere));
}

std::vector<Sample> sampleTruth(const GreyVolume& volume, std::vector<glm::ivec3>& texels, double radius,
                                const glm::ivec3& box) {
    std::vector<Sample> samples(texels.size());
    parallelFor(static_cast<int>(texels.size()), [&](int n) {
        Sample& s = samples[static_cast<std::size_t>(n)];
        const glm::ivec3 texel = texels[static_cast<std::size_t>(n)];
        s.truth = traceOpenness(volume, texel, radius, 128);
        s.vicinity = opennessByDirections(volume, texel, DirectionMethod::Vicinity, radius);
        s.obscurance42 = opennessByDirections(volume, texel, DirectionMethod::Obscurance, radius);
        s.box = bench::numbersOfBox(volume, texel, box);
    });
    return samples;
}

// Texels whose value is an end of their box's: there the reconstruction is 0 or 1 whatever the rest.
void printEnds(const OpennessVolume& openness, const std::vector<glm::ivec3>& texels) {
    double least = 0, most = 0;
    for (const glm::ivec3& texel : texels) {
        least += openness.at(texel) == 0;
        most += openness.at(texel) == 255;
    }
    const double percent = 100.0 / static_cast<double>(texels.size());
    std::printf("  %.1f %% of the texels reconstructed as 0, %.1f %% as 1\n", percent * least,
                percent * most);
}

void printErrors(const char* name, const GreyVolume& volume, double isovalue, int radius) {
    if (volume.empty()) return void(std::printf("%s: not found\n", name));
    const glm::dvec3 spacing = volume.frame.spacing;
    const double metres = radius * std::min({spacing.x, spacing.y, spacing.z});
    const glm::ivec3 box = occlusionRadius(volume.frame, metres);
    std::vector<glm::ivec3> texels = bench::surfaceTexels(volume, isovalue, 1500);
    const std::vector<Sample> samples = sampleTruth(volume, texels, metres, box);
    std::printf("%s, surface at %g, radius %d (box %d %d %d), %zu texels\n", name, isovalue, radius, box.x,
                box.y, box.z, texels.size());
    const auto row = [&](const char* method, const auto& value) {
        bench::Numbers values;
        for (std::size_t n = 0; n < texels.size(); ++n) values.push_back(value(n));
        printRow(method, values, samples);
    };
    const auto estimate = [&](const char* method, OcclusionMethod which) {
        Progress progress;
        const OpennessVolume openness = estimateOpenness(volume, which, box, progress);
        if (which == OcclusionMethod::Reconstructed) printEnds(openness, texels);
        row(method, [&](std::size_t n) { return openness.at(texels[n]) / 255.0; });
    };
    estimate("CDF reconstruction", OcclusionMethod::Reconstructed);
    estimate("CDF within 3 sigma", OcclusionMethod::DrawnIn);
    estimate("Gaussian CDF", OcclusionMethod::Gaussian);
    estimate("Chebyshev (Penner)", OcclusionMethod::Chebyshev);
    row("vicinity (Stewart)", [&](std::size_t n) { return samples[n].vicinity; });
    row("obscurance, 42 (Ruiz)", [&](std::size_t n) { return samples[n].obscurance42; });
    row("beta distribution", [&](std::size_t n) { return bench::betaOpenness(samples[n].box); });
    row("Gaussian, cut off", [&](std::size_t n) { return bench::cutGaussianOpenness(samples[n].box); });
    row("t^beta within 2 sigma", [&](std::size_t n) { return bench::drawnInOpenness(samples[n].box, 2); });
    row("box, counted", [&](std::size_t n) { return samples[n].box.share; });
    row("tangent sphere", [&](std::size_t n) { return samples[n].truth.sphere; });
    row("visible within R", [&](std::size_t n) { return samples[n].truth.visible; });
    row("1 for all", [&](std::size_t) { return 1.0; });
}

void printAllErrors() {
    std::printf(
        "root mean square error of O, min(2 O, 1), min(k O, 1) with the best k from ray-traced\n"
        "obscurance; rank correlation with it, with what is visible within R, with the tangent sphere\n");
    const GreyVolume head = foundVolume("ct/headsq/quarter.nhdr");
    const GreyVolume bonsai = foundVolume("ct/bonsai.nii.gz");
    const GreyVolume trunk = foundVolume("ct/trunk_ct_3mm.nii.gz");
    for (const int radius : {5, 10}) {
        printErrors("headsq, skin", head, 500, radius);
        printErrors("headsq, bone", head, 1150, radius);
        printErrors("bonsai", bonsai, 40, radius);
        printErrors("trunk, skin", trunk, -300, radius);
        printErrors("trunk, bone", trunk, 250, radius);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const auto asked = [&](const char* name) { return argc > 1 && std::strcmp(argv[1], name) == 0; };
    try {
        if (asked("--marks")) {
            printOcclusionMarks();
            return 0;
        }
        if (!asked("--errors")) printTimes();
        if (!asked("--times")) printAllErrors();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
