// Wyman et al. 2006 beside this program: Table 1 (times of baking by samples), fig. 7 (error by samples) and
// Table 2 (frames and memory).
#include "app/report/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "app/report/papers/data.h"
#include "app/report/papers/run.h"
#include "app/report/papers/view.h"
#include "engine/base/parallel.h"
#include "engine/light/paths/isovalue_field.h"
#include "engine/light/skies/spherical_harmonics.h"

namespace stereonav {
namespace {

constexpr const char* kWyman = "Wyman et al. 2006";
constexpr std::array<int, 4> kPaperSamples{100, 625, 2500, 10000};

struct Table1Row {
    const char* name;
    std::array<double, 4> minutes;
};
constexpr Table1Row kTable1[] = {{"Sphr. Harm. (lazy compute)", {0.33, 2.63, 10.6, 48.2}},
                                 {"Sphr. Harm. (full texture)", {8.47, 52.8, 210, 853}},
                                 {"Irradiance (lazy compute)", {0.95, 5.80, 23.7, 98.3}},
                                 {"Irradiance (full texture)", {18.2, 113, 450, 1806}},
                                 {"Pathtraced (single image)", {0.73, 4.51, 18.0, 72.1}}};

constexpr const char* kWhyRates =
    "Theirs: 30 R12000 of 400 MHz, naive sampling, a prototype. Ours: rays of a packet in vectors that leap "
    "over what holds no surface, on the threads named; a figure that is a rate was not run to its end.";

PaperRow rowOf(const char* table, const std::string& row, const std::string& column) {
    return {.paper = kWyman, .table = table, .row = row, .column = column};
}

// Returns which share was run, and the time for all of it on a machine that does nothing else.
std::string rateText(const BakeRate& rate) {
    return (rate.part >= 1 ? "run to its end"
                           : fmt::format("rate of {:.2g} s on {} %, scaled", rate.all_s * rate.part,
                                         numberText(100 * rate.part))) +
           fmt::format("; {} min of one processor", numberText(rate.processor_s / 60));
}

class Table1 {
public:
    Table1(ReportRun& run, const PaperEngine& engine, const EngineView& view)
        : mRun(run),
          mLighter(engine.volume, engine.volume.frame, engine.setup, sampling(run)),
          mSeen(view.seen(run.quick() ? 200 : 900)),
          mAll(inSmallPieces(shuffledBricks(engine.volume.frame.size))),
          mMeasured(fmt::format("{}, {} bounces, {} threads; one view: {} texels, {} pixels", engine.title,
                                engine.setup.bounces, threadCount(), mSeen.texelCount, mSeen.pixelCount)) {
        run.tell("light, what rays leap by");
        const Stopwatch watch;
        const IsovalueFields fields(engine.volume, true);
        parallelFor(fields.rungs(), [&](int n) { fields.field(n); });
        mFields_s = watch.elapsed_ms() / 1000;
        irradianceRate(mLighter, mAll, 1, run.quick() ? 0.2 : 1.5);
    }

    void add(std::vector<PaperRow>& rows, double seconds) {
        const double each = seconds / static_cast<double>(kPaperSamples.size() * std::size(kTable1));
        for (const Table1Row& theirs : kTable1)
            for (std::size_t s = 0; s < kPaperSamples.size(); ++s) {
                mRun.tell(fmt::format("light, {}, {} samples", theirs.name, kPaperSamples[s]));
                const auto [rate, before_s] = rateOf(&theirs - kTable1, kPaperSamples[s], each);
                PaperRow row = rowOf("Table 1", theirs.name, fmt::format("{} samples", kPaperSamples[s]));
                row.theirs = theirs.minutes[s];
                row.ours = exactly((before_s + rate.all_s) / 60);
                row.unit = "min";
                row.measured = mMeasured;
                row.how = rateText(rate);
                row.why = kWhyRates;
                row.kind = PaperRow::Kind::Time;
                rows.push_back(std::move(row));
            }
    }

private:
    static TexelSampling sampling(ReportRun& run) {
        TexelSampling s;
        s.seed = run.options().seed;
        return s;
    }

    // Returns the rate, and the seconds before the first texel of a whole texture.
    std::pair<BakeRate, double> rateOf(std::ptrdiff_t line, int samples, double seconds) const {
        const auto transfer = [&](const std::vector<TexelPiece>& pieces) {
            return transferRate(mLighter, pieces, samples, kPaperOrder, 1, seconds);
        };
        switch (line) {
            case 0:
                return {transfer(mSeen.texels), 0};
            case 1:
                return {transfer(mAll), mFields_s};
            case 2:
                return {irradianceRate(mLighter, mSeen.texels, samples, seconds), 0};
            case 3:
                return {irradianceRate(mLighter, mAll, samples, seconds), mFields_s};
            default:
                return {pointRate(mLighter, mSeen.pixels, samples, seconds), 0};
        }
    }

    ReportRun& mRun;
    TexelLighter mLighter;
    EngineView::Seen mSeen;
    std::vector<TexelPiece> mAll;
    std::string mMeasured;
    double mFields_s = 0;
};

// Sums over two runs with independent noise: their difference has twice the variance of one.
struct NoiseSums {
    double squares = 0, light = 0;
    std::size_t texels = 0;

    void add(double a, double b) {
        squares += 0.5 * (a - b) * (a - b);
        light += 0.5 * (a + b);
        ++texels;
    }
    double relative_percent() const {
        return light > 0 ? 100 * std::sqrt(squares * static_cast<double>(texels)) / light : 0;
    }
};

// Returns the light of a piece of texels with one of two seeds; negative for texels that lie on no surface.
using LightOf = std::function<std::vector<double>(int seed, const TexelPiece& piece)>;

NoiseSums noiseOf(const std::vector<TexelPiece>& pieces, double seconds, const LightOf& lightOf) {
    NoiseSums sums;
    std::mutex mutex;
    std::vector<std::size_t> sizes(pieces.size());
    std::ranges::transform(pieces, sizes.begin(), &TexelPiece::size);
    bakeRate(sizes, seconds, 1, [&](std::size_t n) {
        const std::vector<double> a = lightOf(0, pieces[n]), b = lightOf(1, pieces[n]);
        const std::lock_guard<std::mutex> lock(mutex);
        for (std::size_t k = 0; k < a.size(); ++k)
            if (a[k] >= 0 && b[k] >= 0) sums.add(a[k], b[k]);
        return a.size();
    });
    return sums;
}

// Adds fig. 7: noise by number of samples.
void addNoise(ReportRun& run, const PaperEngine& engine, const EngineView& view, double seconds,
              std::vector<PaperRow>& rows) {
    const EngineView::Seen seen = view.seen(run.quick() ? 100 : 300);
    const std::vector<glm::vec3> sky = engine.setup.probe->project(kPaperOrder);
    const auto lighters = [&](bool naive) {
        std::vector<std::unique_ptr<TexelLighter>> both;
        for (const std::uint64_t seed : {101, 202}) {
            TexelSampling sampling;
            sampling.naive = naive;
            sampling.seed = 1000 * run.options().seed + seed;
            both.push_back(
                std::make_unique<TexelLighter>(engine.volume, engine.volume.frame, engine.setup, sampling));
        }
        return both;
    };
    const auto own = lighters(false), naive = lighters(true);
    const auto irradiance = [](const std::vector<std::unique_ptr<TexelLighter>>& both, int samples) {
        return [&both, samples](int seed, const TexelPiece& piece) {
            std::vector<TexelSum> sums(piece.size());
            both[static_cast<std::size_t>(seed)]->addIrradiance(piece, samples, sums);
            std::vector<double> light;
            light.reserve(sums.size());
            for (const TexelSum& sum : sums)
                light.push_back(sum.samples > 0 ? luminance(glm::dvec3(sum.mean)) : -1);
            return light;
        };
    };
    const auto harmonics = [&](int samples) {
        return [&, samples](int seed, const TexelPiece& piece) {
            const std::size_t numbers = sky.size();
            std::vector<float> sums(piece.size() * numbers);
            std::vector<std::uint8_t> alive(piece.size());
            own[static_cast<std::size_t>(seed)]->addTransfer(piece, 0, samples, kPaperOrder, 1, sums, alive);
            std::vector<double> light;
            light.reserve(piece.size());
            for (std::size_t n = 0; n < piece.size(); ++n) {
                double sum = 0;
                for (std::size_t k = 0; k < numbers; ++k)
                    sum +=
                        static_cast<double>(sums[n * numbers + k]) * luminance(glm::dvec3(sky[k])) / samples;
                light.push_back(alive[n] ? std::max(sum, 0.0) : -1);
            }
            return light;
        };
    };
    const double each = seconds / static_cast<double>(3 * kPaperSamples.size());
    const auto add = [&](const char* name, const char* said, int samples, const LightOf& light) {
        run.tell(fmt::format("light, noise of {} samples", samples));
        const NoiseSums sums = noiseOf(seen.texels, each, light);
        PaperRow row = rowOf("Fig. 7, noise", name, fmt::format("{} samples", samples));
        row.said = said;
        row.ours = exactly(sums.relative_percent());
        row.unit = "% of the light";
        row.measured = engine.title + ", texels that one view looks up";
        row.how = fmt::format("two runs on {} texels", sums.texels);
        row.why =
            "They show pictures: root of the mean square of the noise, of the mean light. Few texels where "
            "samples are many.";
        row.kind = PaperRow::Kind::Other;  // depends on the number of texels measured in time
        rows.push_back(std::move(row));
    };
    for (const int samples : kPaperSamples)
        add("Spherical harmonics", "converge faster than irradiance", samples, harmonics(samples));
    for (const int samples : kPaperSamples)
        add("Irradiance", "100 samples often suffice", samples, irradiance(own, samples));
    for (const int samples : kPaperSamples)
        add("Irradiance, naive sampling as theirs", "10,000 often unnecessary", samples,
            irradiance(naive, samples));
}

void addFrames(ReportRun& run, const PaperEngine& engine, EngineView& view, std::vector<PaperRow>& rows) {
    const int side = run.quick() ? 128 : 512;
    const EngineView::FrameTimes times = view.frameTimes(run, side, run.pick(5, 40));
    const std::string measured =
        fmt::format("{}, {}x{}, {} threads", engine.title, side, side, threadCount());
    const auto add = [&](const char* name, const Spread& ms, double fps, double relative) {
        PaperRow rate = rowOf("Table 2, frames a second", name, "30 CPUs there");
        rate.theirs = fps;
        rate.ours = {1000 / ms.median, 1000 / ms.high, 1000 / ms.low, ms.count};
        rate.unit = "frames/s";
        rate.measured = measured;
        rate.why = "Theirs: 600 MHz R14000, a ray at a time.";
        rows.push_back(rate);
        PaperRow share = rowOf("Table 2, frames a second", name, "rate, of diffuse without shadows");
        share.theirs = relative;
        share.ours = exactly(times.diffuse.low / ms.low);
        share.unit = "of 1";
        share.measured = measured;
        share.why =
            "Hard shadow rays of packets are cheaper here beside the first ray than there. Harmonics are "
            "dotted anew each frame here, of what is in view; theirs dots at each pixel.";
        rows.push_back(std::move(share));
    };
    add("Diffuse (no shadows)", times.diffuse, 17.0, 1);
    add("Diffuse (with shadows)", times.shadowed, 8.75, 8.75 / 17);
    add("Phong (with shadows)", times.phongShadowed, 8.60, 8.60 / 17);
    add("Irradiance", times.irradiance, 15.6, 15.6 / 17);
    add("Spherical harmonics", times.harmonics, 11.7, 11.7 / 17);
}

void addMemory(const PaperEngine& engine, const EngineView& view, std::vector<PaperRow>& rows) {
    constexpr double kMegabyte = 1 << 20;  // in their unit: 9.75 MB are three bytes per texel
    const EngineView::Memory held = view.memory();
    const auto texels = static_cast<double>(engine.volume.frame.count());
    const double numbers = harmonicsCount(kPaperOrder);
    const auto add = [&](const char* name, const char* column, double theirs, double bytes,
                         const std::string& what, const char* why) {
        PaperRow row = rowOf("Table 2, extra memory", name, column);
        row.theirs = theirs;
        row.ours = exactly(bytes / kMegabyte);
        row.unit = "MB";
        row.measured = engine.title + ", " + what;
        row.why = why;
        row.kind = PaperRow::Kind::Error;
        rows.push_back(std::move(row));
    };
    const std::string all = fmt::format("{:.0f} texels", texels),
                      some = fmt::format("{} texels", held.texels);
    constexpr const char* kWhyAll =
        "Theirs: three bytes a texel, and 25 floats a channel. Ours: four half floats, and 25 half floats of "
        "one channel (grey albedo).";
    constexpr const char* kWhySome =
        "As above, and only pages of texels that lookups on the surface shown ask for are taken.";
    add("Irradiance", "a texel for every voxel", 9.75, texels * sizeof(PackedTexel), all, kWhyAll);
    add("Irradiance", "where the surface is", 9.75, static_cast<double>(held.irradianceBytes), some,
        kWhySome);
    add("Spherical harmonics", "a texel for every voxel", 975, texels * numbers * sizeof(std::uint16_t), all,
        kWhyAll);
    add("Spherical harmonics", "where the surface is", 975, static_cast<double>(held.harmonicsBytes), some,
        kWhySome);
}

}  // namespace

void reportPapersLight(ReportRun& run, double seconds) {
    const PaperData data(run.options().data);
    run.tell("light, the engine");
    const PaperEngine engine = paperEngine(data);
    EngineView view(engine);
    ReportSection section{"papers-light",
                          "Wyman et al. 2006: baked light",
                          "Interactive display of isosurfaces with global illumination.",
                          {}};
    std::vector<PaperRow> rows;
    Table1(run, engine, view).add(rows, 0.6 * seconds);
    addNoise(run, engine, view, 0.25 * seconds, rows);
    addFrames(run, engine, view, rows);
    addMemory(engine, view, rows);
    addPaperRows(run.report(), section, std::move(rows));
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
