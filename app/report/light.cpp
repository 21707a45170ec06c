// The report's part on precomputed light: irradiance and transfer by number of samples and order, on texels
// of a small block under a clear sky; the other charts are in relight.cpp and pixels.cpp.
#include "app/report/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/light/paths/texel_light.h"
#include "engine/light/skies/sky_probe.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/light/transfer/bake_texels.h"

namespace stereonav {

LightSetup clearSkyLight() {
    LightSetup setup;
    ClearSky sky;
    sky.height = 64;
    setup.probe = std::make_shared<LightProbe>(clearSkyProbe(sky));
    setup.bounces = kReportBounces;
    return setup;
}

std::vector<double> LightSubject::onlyLit(const std::vector<double>& all) const {
    std::vector<double> some;
    for (std::size_t n = 0; n < all.size(); ++n)
        if (lit[n]) some.push_back(all[n]);
    return some;
}

TexelLighter LightSubject::lighter(bool naive, std::uint64_t run) const {
    TexelSampling sampling;
    sampling.naive = naive;
    sampling.seed = 1000 * seed + run;
    return TexelLighter(volume, volume.frame, setup, sampling);
}

void forTexels(std::size_t texels, const std::function<void(std::size_t, std::size_t)>& job) {
    constexpr std::size_t kTexelsAtOnce = 64;
    const int jobs = static_cast<int>((texels + kTexelsAtOnce - 1) / kTexelsAtOnce);
    parallelFor(jobs, [&](int n) {
        const std::size_t first = static_cast<std::size_t>(n) * kTexelsAtOnce;
        job(first, std::min<std::size_t>(kTexelsAtOnce, texels - first));
    });
}

namespace {

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
    for (const TexelSum& sum : baked.sums) light.push_back(luminance(glm::dvec3(sum.mean)));
    return subject.onlyLit(light);
}

// most: approximate number of bricks of the surface to measure.
LightSubject makeSubject(std::uint64_t seed, int most) {
    LightSubject subject;
    subject.seed = seed;
    Progress quiet;
    const auto all = wantedBricks(
        subject.volume, subject.volume.frame,
        {static_cast<float>(kBlockSurface), static_cast<float>(kBlockSurface), nullptr, false}, quiet);
    subject.allBricks = all;
    const std::size_t every = std::max<std::size_t>(1, all.size() / static_cast<std::size_t>(most));
    const TexelLayout layout(subject.volume.frame.size);
    for (std::size_t n = 0; n < all.size(); n += every) {
        subject.bricks.push_back(all[n]);
        for (const glm::ivec3& texel : texelsIn(layout, all[n])) subject.texels.push_back(texel);
    }
    subject.lit.resize(subject.texels.size());
    return subject;
}

struct LightTruthOrder {
    std::uint64_t seed;
    int bricks, run, samples;
};

// Sets the truth to the mean of several runs, whose seeds no measured run has.
void findTruth(ReportRun& run, LightSubject& subject, int bricks) {
    const int runs = run.pick(4, 8), samples = run.pick(512, 2048);
    std::vector<UntimedPiece> pieces;
    pieces.reserve(static_cast<std::size_t>(runs));
    for (int n = 0; n < runs; ++n)
        pieces.push_back(pieceOf(Untimed::LightTruth, LightTruthOrder{subject.seed, bricks, n, samples}));
    std::vector<double> sum;
    for (const PeerBytes& piece : run.untimed().all(pieces)) {
        const Baked baked{ByteReader(piece).getArray<TexelSum>(), 0};
        for (std::size_t k = 0; k < baked.sums.size(); ++k) subject.lit[k] = baked.sums[k].samples > 0;
        const std::vector<double> light = lightOf(subject, baked);
        sum.resize(light.size());
        for (std::size_t k = 0; k < light.size(); ++k) sum[k] += light[k] / runs;
    }
    subject.truth = std::move(sum);
    subject.truthSamples = runs * samples;
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
        const TexelLighter lighter = subject.lighter(naive, kFirstSeed + static_cast<std::uint64_t>(n));
        bakeIrradiance(subject, lighter, 1);  // finds the empty space that rays leap over
        const Baked baked = bakeIrradiance(subject, lighter, samples);
        const std::vector<double> light = lightOf(subject, baked);
        squares += std::pow(relativeRms(light, subject.truth), 2) / runs;
        worst = std::max(worst, relativeWorst(light, subject.truth));
        ms.push_back(baked.ms);
    }
    return {{fmt::format("{}{}", naive ? "naive " : "", samples), perThousand(ms, subject),
             100 * std::sqrt(squares), !naive && samples == kDefaultSamples},
            fmt::format("{} samples a texel, {}", samples,
                        naive ? "uniform directions, no knowledge of the sky"
                              : "directions by cosine and by the sky's brightness"),
            100 * worst};
}

WayChart irradianceChart(ReportRun& run, const LightSubject& subject) {
    WayChart chart = lightChart(run, subject, "light/irradiance", "Irradiance by samples");
    for (const int samples : {1, 4, 16, 64, 256, 1024})
        chart.points.push_back(irradiancePoint(run, subject, false, samples));
    for (const int samples : {16, 64, 256})
        chart.points.push_back(irradiancePoint(run, subject, true, samples));
    return chart;
}

std::vector<double> dotted(const LightSubject& subject, const MeasuredTransfer& t, int order) {
    const std::vector<glm::vec3> sky = subject.setup.probe->project(order);
    std::vector<double> light;
    for (std::size_t n = 0; n < subject.texels.size(); ++n) {
        double sum = 0;
        for (std::size_t k = 0; k < sky.size(); ++k)
            sum += static_cast<double>(t.means[n * sky.size() + k]) * luminance(glm::dvec3(sky[k]));
        light.push_back(std::max(sum, 0.0));
    }
    return subject.onlyLit(light);
}

WayChart transferChart(ReportRun& run, const LightSubject& subject) {
    WayChart chart = lightChart(run, subject, "light/transfer", "Transfer by samples and order");
    chart.text +=
        " Transfer holds the sky's first harmonics alone: what an order leaves out no samples bring back.";
    const auto point = [&](int order, int samples) {
        std::vector<double> ms;
        double squares = 0, worst = 0;
        const int runs = run.pick(2, 4);
        for (int n = 0; n < runs; ++n) {
            run.tell("light, transfer");
            const MeasuredTransfer t = bakeTransfer(
                subject, subject.lighter(false, kFirstSeed + static_cast<std::uint64_t>(n)), order, samples);
            const std::vector<double> light = dotted(subject, t, order);
            squares += std::pow(relativeRms(light, subject.truth), 2) / runs;
            worst = std::max(worst, relativeWorst(light, subject.truth));
            ms.push_back(t.ms);
        }
        chart.points.push_back(
            {{fmt::format("order {} at {}", order, samples), perThousand(ms, subject),
              100 * std::sqrt(squares), order == kDefaultOrder && samples == kDefaultSamples},
             fmt::format("{} numbers, {} samples a texel", harmonicsCount(order), samples),
             100 * worst});
    };
    for (const int samples : {16, 64, 256, 1024}) point(kDefaultOrder, samples);
    for (const int order : {1, 2, 3, 4, 6}) point(order, kDefaultSamples);
    return chart;
}

}  // namespace

PeerBytes makeLightTruth(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<LightTruthOrder>();
    run.tell("light, the truth");
    const auto subject =
        run.untimed().kept<LightSubject>(fmt::format("light {} {}", asked.seed, asked.bricks),
                                         [&] { return makeSubject(asked.seed, asked.bricks); });
    const TexelLighter lighter = subject->lighter(false, static_cast<std::uint64_t>(asked.run));
    const Baked baked = bakeIrradiance(*subject, lighter, asked.samples);
    return ByteWriter().putArray(std::span<const TexelSum>(baked.sums)).take();
}

MeasuredTransfer bakeTransfer(const LightSubject& subject, const TexelLighter& lighter, int order,
                              int samples) {
    const std::size_t numbers = static_cast<std::size_t>(harmonicsCount(order));
    MeasuredTransfer t{std::vector<float>(subject.texels.size() * numbers), 0};
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

static std::string subjectText(const LightSubject& subject) {
    return fmt::format(
        "A made block with three holes under a clear sky, {} bounces; {} texels on its surface; truth: "
        "irradiance path-traced with {} samples.",
        kReportBounces, subject.truth.size(), subject.truthSamples);
}

WayChart lightChart(ReportRun& run, const LightSubject& subject, const char* id, const char* title) {
    WayChart chart;
    chart.id = id;
    chart.title = title;
    chart.text = subjectText(subject);
    chart.setting = fmt::format("{} texels, {} threads, seed {}, truth of {} samples", subject.truth.size(),
                                threadCount(), run.options().seed, subject.truthSamples);
    chart.timeLabel = "ms for 1000 texels";
    chart.errorLabel = "RMS error, % of the light";
    chart.errorUnit = "%";
    return chart;
}

void reportLight(ReportRun& run, double) {
    const int bricks = run.pick(6, 24);
    LightSubject subject = makeSubject(run.options().seed, bricks);
    findTruth(run, subject, bricks);
    ReportSection section{"light", "Precomputed light", "", {}};
    addChart(run.report(), section, irradianceChart(run, subject));
    addChart(run.report(), section, transferChart(run, subject));
    addChart(run.report(), section, relightChart(run, subject));
    addPixelCharts(run, section);
    run.checkTime();
    addChart(run.report(), section, terrainLightChart(run));
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
