// The report's part on precomputed light: irradiance and transfer by number of samples, transfer by order and
// compression, on texels of a small block under a clear sky.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/report_run.h"
#include "app/report_subjects.h"
#include "engine/base/parallel.h"
#include "engine/light/bake_texels.h"
#include "engine/light/sky_probe.h"
#include "engine/light/spherical_harmonics.h"
#include "engine/light/texel_light.h"
#include "engine/light/transfer_compression.h"
#include "engine/light/transfer_volume.h"

namespace stereonav {
namespace {

constexpr int kBounces = 2, kDefaultOrder = 5, kDefaultSamples = 256;  // what bake does where nothing is said
constexpr int kTexelsAtOnce = 64;
constexpr int kFirstSeed = 100;  // of the runs that are measured; the truth has those before

double luminance(const glm::vec3& c) {
    return 0.2126 * static_cast<double>(c.x) + 0.7152 * static_cast<double>(c.y) +
           0.0722 * static_cast<double>(c.z);
}

struct LightSubject {
    GreyVolume volume = blockWithHoles();
    LightSetup setup;
    std::vector<TexelBrick> allBricks, bricks;  // of the surface; those of them that are measured on
    std::vector<glm::ivec3> texels;             // of the latter, one after another
    std::vector<bool> lit;                      // on a surface
    std::vector<double> truth;                  // irradiance / pi of those that are lit
    int truthSamples = 0;
    std::uint64_t seed = 1;

    std::vector<double> onlyLit(const std::vector<double>& all) const {
        std::vector<double> some;
        for (std::size_t n = 0; n < all.size(); ++n)
            if (lit[n]) some.push_back(all[n]);
        return some;
    }
    TexelLighter lighter(bool naive, std::uint64_t run) const {
        TexelSampling sampling;
        sampling.naive = naive;
        sampling.seed = 1000 * seed + run;
        return TexelLighter(volume, volume.frame, setup, sampling);
    }
};

// Calls job(first, count) for runs of texels, on all threads.
void forTexels(std::size_t texels, const std::function<void(std::size_t, std::size_t)>& job) {
    const int jobs = static_cast<int>((texels + kTexelsAtOnce - 1) / kTexelsAtOnce);
    parallelFor(jobs, [&](int n) {
        const std::size_t first = static_cast<std::size_t>(n) * kTexelsAtOnce;
        job(first, std::min<std::size_t>(kTexelsAtOnce, texels - first));
    });
}

struct Baked {
    std::vector<TexelSum> sums;
    double ms = 0;
};

Baked bakeIrradiance(const LightSubject& subject, const TexelLighter& lighter, int samples) {
    Baked baked{std::vector<TexelSum>(subject.texels.size()), 0};
    const Stopwatch watch;
    forTexels(subject.texels.size(), [&](std::size_t first, std::size_t count) {
        lighter.addIrradiance(std::span(subject.texels).subspan(first, count), samples,
                              std::span(baked.sums).subspan(first, count));
    });
    baked.ms = watch.elapsed_ms();
    return baked;
}

std::vector<double> lightOf(const LightSubject& subject, const Baked& baked) {
    std::vector<double> light;
    for (const TexelSum& sum : baked.sums) light.push_back(luminance(sum.mean));
    return subject.onlyLit(light);
}

LightSubject makeSubject(ReportRun& run) {
    LightSubject subject;
    subject.seed = run.options().seed;
    ClearSky sky;
    sky.height = 64;
    subject.setup.probe = std::make_shared<LightProbe>(clearSkyProbe(sky));
    subject.setup.bounces = kBounces;
    Progress quiet;
    const auto all = wantedBricks(
        subject.volume, subject.volume.frame,
        {static_cast<float>(kBlockSurface), static_cast<float>(kBlockSurface), nullptr, false}, quiet);
    subject.allBricks = all;
    const std::size_t every =
        std::max<std::size_t>(1, all.size() / static_cast<std::size_t>(run.pick(6, 24)));
    const TexelLayout layout(subject.volume.frame.size);
    for (std::size_t n = 0; n < all.size(); n += every) {
        subject.bricks.push_back(all[n]);
        for (const glm::ivec3& texel : texelsIn(layout, all[n])) subject.texels.push_back(texel);
    }
    subject.lit.resize(subject.texels.size());
    return subject;
}

// The mean of runs that nothing measured shares a seed with.
void findTruth(ReportRun& run, LightSubject& subject) {
    const int runs = run.pick(4, 8), samples = run.pick(512, 2048);
    std::vector<double> sum;
    for (int n = 0; n < runs; ++n) {
        run.tell("light, the truth");
        const Baked baked =
            bakeIrradiance(subject, subject.lighter(false, static_cast<std::uint64_t>(n)), samples);
        for (std::size_t k = 0; k < baked.sums.size(); ++k) subject.lit[k] = baked.sums[k].samples > 0;
        const std::vector<double> light = lightOf(subject, baked);
        sum.resize(light.size());
        for (std::size_t k = 0; k < light.size(); ++k) sum[k] += light[k] / runs;
    }
    subject.truth = std::move(sum);
    subject.truthSamples = runs * samples;
}

std::string subjectText(const LightSubject& subject) {
    return fmt::format(
        "A made block with three holes under a clear sky, {} bounces; {} texels on its surface; truth: "
        "irradiance path-traced with {} samples.",
        kBounces, subject.truth.size(), subject.truthSamples);
}

WayChart chartFor(ReportRun& run, const LightSubject& subject, const char* id, const char* title) {
    WayChart chart;
    chart.id = id;
    chart.title = title;
    chart.text = subjectText(subject);
    chart.setting = fmt::format("{} texels, {} threads, seed {}, truth of {} samples", subject.truth.size(),
                                threadCount(), run.options().seed, subject.truthSamples);
    chart.timeLabel = "ms for 1000 texels";
    chart.timeUnit = "ms";
    chart.errorLabel = "RMS error, % of the light";
    chart.errorUnit = "%";
    return chart;
}

Spread perThousand(const std::vector<double>& ms, const LightSubject& subject) {
    return scaled(spreadOf(ms), 1000 / static_cast<double>(std::max<std::size_t>(subject.texels.size(), 1)));
}

WayPoint irradiancePoint(ReportRun& run, const LightSubject& subject, bool naive, int samples) {
    const int runs = run.pick(3, 5);
    std::vector<double> ms;
    double squares = 0, worst = 0;
    for (int n = 0; n < runs; ++n) {
        run.tell("light, irradiance");
        const TexelLighter lighter = subject.lighter(naive, static_cast<std::uint64_t>(kFirstSeed + n));
        bakeIrradiance(subject, lighter, 1);  // finds what rays leap by
        const Baked baked = bakeIrradiance(subject, lighter, samples);
        const std::vector<double> light = lightOf(subject, baked);
        squares += std::pow(relativeRms(light, subject.truth), 2) / runs;
        worst = std::max(worst, relativeWorst(light, subject.truth));
        ms.push_back(baked.ms);
    }
    WayPoint point;
    point.way = {fmt::format("{}{}", naive ? "naive " : "", samples), perThousand(ms, subject),
                 100 * std::sqrt(squares), !naive && samples == kDefaultSamples};
    point.worstError = 100 * worst;
    point.detail = fmt::format("{} samples a texel, {}", samples,
                               naive ? "uniform directions, no knowledge of the sky"
                                     : "directions by cosine and by the sky's brightness");
    return point;
}

WayChart irradianceChart(ReportRun& run, const LightSubject& subject) {
    WayChart chart = chartFor(run, subject, "light/irradiance", "Irradiance by samples");
    for (const int samples : {1, 4, 16, 64, 256, 1024})
        chart.points.push_back(irradiancePoint(run, subject, false, samples));
    for (const int samples : {16, 64, 256})
        chart.points.push_back(irradiancePoint(run, subject, true, samples));
    return chart;
}

struct Transfer {
    std::vector<float> means;  // order^2 a texel
    double ms = 0;
};

Transfer bakeTransfer(const LightSubject& subject, const TexelLighter& lighter, int order, int samples) {
    const std::size_t numbers = static_cast<std::size_t>(harmonicsCount(order));
    Transfer t{std::vector<float>(subject.texels.size() * numbers), 0};
    std::vector<std::uint8_t> alive(subject.texels.size());
    const Stopwatch watch;
    forTexels(subject.texels.size(), [&](std::size_t first, std::size_t count) {
        lighter.addTransfer(std::span(subject.texels).subspan(first, count), 0, samples, order, 1,
                            std::span(t.means).subspan(first * numbers, count * numbers),
                            std::span(alive).subspan(first, count));
    });
    t.ms = watch.elapsed_ms();
    for (float& mean : t.means) mean /= static_cast<float>(samples);
    return t;
}

std::vector<double> dotted(const LightSubject& subject, const Transfer& t, int order) {
    const std::vector<glm::vec3> sky = subject.setup.probe->project(order);
    std::vector<double> light;
    for (std::size_t n = 0; n < subject.texels.size(); ++n) {
        double sum = 0;
        for (std::size_t k = 0; k < sky.size(); ++k)
            sum += static_cast<double>(t.means[n * sky.size() + k]) * luminance(sky[k]);
        light.push_back(std::max(sum, 0.0));
    }
    return subject.onlyLit(light);
}

WayChart transferChart(ReportRun& run, const LightSubject& subject) {
    WayChart chart = chartFor(run, subject, "light/transfer", "Transfer by samples and order");
    chart.text +=
        " Transfer holds the sky's first harmonics alone: what an order leaves out no samples bring back.";
    const auto point = [&](int order, int samples) {
        std::vector<double> ms;
        double squares = 0, worst = 0;
        const int runs = run.pick(2, 4);
        for (int n = 0; n < runs; ++n) {
            run.tell("light, transfer");
            const Transfer t = bakeTransfer(
                subject, subject.lighter(false, static_cast<std::uint64_t>(kFirstSeed + n)), order, samples);
            const std::vector<double> light = dotted(subject, t, order);
            squares += std::pow(relativeRms(light, subject.truth), 2) / runs;
            worst = std::max(worst, relativeWorst(light, subject.truth));
            ms.push_back(t.ms);
        }
        WayPoint p;
        p.way = {fmt::format("order {} at {}", order, samples), perThousand(ms, subject),
                 100 * std::sqrt(squares), order == kDefaultOrder && samples == kDefaultSamples};
        p.worstError = 100 * worst;
        p.detail = fmt::format("{} numbers, {} samples a texel", harmonicsCount(order), samples);
        chart.points.push_back(std::move(p));
    };
    for (const int samples : {16, 64, 256, 1024}) point(kDefaultOrder, samples);
    for (const int order : {1, 2, 3, 4, 6}) point(order, kDefaultSamples);
    return chart;
}

// The first bands of every vector.
std::vector<float> firstBands(const std::vector<float>& means, int from, int order) {
    const std::size_t all = static_cast<std::size_t>(harmonicsCount(from)),
                      some = static_cast<std::size_t>(harmonicsCount(order));
    std::vector<float> bands;
    for (std::size_t n = 0; n + all <= means.size(); n += all)
        bands.insert(bands.end(), &means[n], &means[n] + some);
    return bands;
}

// So many that threads are busy for a while.
constexpr std::size_t kRelit = 50'000;

// Numbers of `wanted` texels in all, those that are there again and again.
std::vector<float> repeated(const std::vector<float>& numbers, std::size_t wanted) {
    std::vector<float> more;
    more.reserve(wanted);
    while (more.size() < wanted && !numbers.empty())
        more.insert(
            more.end(), numbers.begin(),
            numbers.begin() + static_cast<std::ptrdiff_t>(std::min(numbers.size(), wanted - more.size())));
    return more;
}

TransferVolume transferOf(const LightSubject& subject, const std::vector<TexelBrick>& bricks,
                          const std::vector<float>& means, int order) {
    const std::size_t numbers = static_cast<std::size_t>(harmonicsCount(order));
    TransferVolume volume(subject.volume.frame, order, 1, bricks);
    const std::vector<float> all = repeated(means, volume.texels() * numbers);
    std::size_t at = 0;
    for (std::size_t n = 0; n < bricks.size(); ++n) {
        const std::size_t count = static_cast<std::size_t>(countTexels(bricks[n].wanted)) * numbers;
        volume.setBrick(n, std::span(all).subspan(at, count));
        at += count;
    }
    return volume;
}

// As the program keeps and relights it: half floats, a pass over all bricks of the surface.
WayPoint relightPoint(ReportRun& run, const LightSubject& subject, const std::vector<float>& means,
                      int order) {
    const std::vector<glm::vec3> sky = subject.setup.probe->project(order);
    const TransferVolume whole = transferOf(subject, subject.allBricks, means, order);
    IlluminationVolume to(subject.volume.frame);
    std::vector<double> ms;
    for (int n = 0; n < run.pick(15, 50); ++n) {
        const Stopwatch watch;
        whole.relightAll(sky, to);
        ms.push_back(watch.elapsed_ms() * 1000 / static_cast<double>(whole.texels()));
    }
    transferOf(subject, subject.bricks, means, order).relightAll(sky, to);
    std::vector<double> light;
    for (const glm::ivec3& t : subject.texels)
        light.push_back(luminance(texelLight(to.texels[to.layout.index(t.x, t.y, t.z)])));
    light = subject.onlyLit(light);
    WayPoint p;
    p.way = {fmt::format("order {}", order), spreadOf(ms), 100 * relativeRms(light, subject.truth),
             order == kDefaultOrder};
    p.worstError = 100 * relativeWorst(light, subject.truth);
    p.others = {{"bytes a texel", 2.0 * harmonicsCount(order)}};
    p.detail = "half floats, as the program keeps them";
    return p;
}

WayPoint compressedPoint(ReportRun& run, const LightSubject& subject, const std::vector<float>& means,
                         int clusters, int components) {
    run.tell("light, compression");
    TransferCompression settings;
    settings.clusters = clusters;
    settings.components = components;
    const CompressedTransfer small = compressTransfer(means, {kDefaultOrder, 1}, settings);
    const std::vector<glm::vec3> sky = subject.setup.probe->project(kDefaultOrder);
    std::vector<double> ms;
    std::vector<glm::vec3> light(kRelit);
    for (int n = 0; n < run.pick(15, 50); ++n) {
        const Stopwatch watch;
        const TransferLight prepared = small.codebook.prepareLight(sky);
        forTexels(light.size(), [&](std::size_t first, std::size_t count) {
            for (std::size_t k = first; k < first + count; ++k)
                light[k] = small.dot(k % small.count(), prepared);
        });
        ms.push_back(watch.elapsed_ms() * 1000 / static_cast<double>(kRelit));
    }
    std::vector<double> all;
    for (std::size_t n = 0; n < subject.texels.size(); ++n) all.push_back(std::max(luminance(light[n]), 0.0));
    const std::vector<double> lit = subject.onlyLit(all);
    WayPoint p;
    p.way = {fmt::format("{} clusters of {}", clusters, components), spreadOf(ms),
             100 * relativeRms(lit, subject.truth), false};
    p.worstError = 100 * relativeWorst(lit, subject.truth);
    p.others = {{"bytes a texel", static_cast<double>(small.codebook.recordBytes())}};
    p.detail =
        fmt::format("clustered principal components of order {}: {} clusters, {} components of a byte each",
                    kDefaultOrder, clusters, components);
    return p;
}

WayChart relightChart(ReportRun& run, const LightSubject& subject) {
    WayChart chart = chartFor(run, subject, "light/relight", "Turning the sky: order and compression");
    chart.text +=
        " Time to dot every texel with a turned sky; error against the path-traced light. Compression found "
        "its clusters "
        "on these very texels; its times are without writing the volume that frames look up. Bytes a texel "
        "are in the "
        "table.";
    chart.why =
        "The program relights half floats into the volume that frames look up; compression is a part of the "
        "engine that "
        "no command uses yet.";
    const int samples = run.pick(512, 2048);
    run.tell("light, transfer");
    const Transfer t = bakeTransfer(subject, subject.lighter(false, kFirstSeed), kMaxHarmonicsOrder, samples);
    for (int order = 1; order <= kMaxHarmonicsOrder; ++order)
        chart.points.push_back(
            relightPoint(run, subject, firstBands(t.means, kMaxHarmonicsOrder, order), order));
    const std::vector<float> means = firstBands(t.means, kMaxHarmonicsOrder, kDefaultOrder);
    for (const auto& [clusters, components] : {std::pair{16, 4}, std::pair{64, 8}, std::pair{128, 12}})
        chart.points.push_back(compressedPoint(run, subject, means, clusters, components));
    return chart;
}

}  // namespace

void reportLight(ReportRun& run, double) {
    LightSubject subject = makeSubject(run);
    findTruth(run, subject);
    ReportSection section{"light", "Precomputed light", "", {}};
    addChart(run.report(), section, irradianceChart(run, subject));
    addChart(run.report(), section, transferChart(run, subject));
    addChart(run.report(), section, relightChart(run, subject));
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
