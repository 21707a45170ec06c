// The report's part on casting rays: translucent walls by sampling distance, exact hits against stepping over
// terrain, leaping over empty cells as an exact pair, and fixed choices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/trial.h"
#include "engine/base/parallel.h"
#include "engine/volume/volume_renderer.h"
#include "terrain/cast/equidistant_caster.h"
#include "terrain/cast/plain_caster.h"

namespace stereonav {
namespace {

constexpr double kFinestStep = 1.0 / 16, kDefaultStep = 0.5;

EyeView viewOf(const ReportScene& scene, int frame, int frames) {
    const Scene& s = scene.loaded();
    const std::size_t n = s.path.samples().empty() ? 0 : static_cast<std::size_t>(frame);
    return makeEyeView(posesOf(s, frames)[n], s.lens);
}

// The left eye of a frame with the finest step.
struct StepTruthOrder {
    std::size_t scene;
    int frame, frames;
};

std::vector<Plane<PackedColor>> stepTruths(ReportRun& run, const ReportScene& scene, int frames) {
    std::vector<UntimedPiece> pieces;
    pieces.reserve(static_cast<std::size_t>(frames));
    for (int n = 0; n < frames; ++n)
        pieces.push_back(pieceOf(Untimed::StepTruth, StepTruthOrder{run.indexOf(scene), n, frames}));
    std::vector<Plane<PackedColor>> truths;
    for (const PeerBytes& piece : run.untimed().all(pieces)) {
        const Lens& lens = scene.loaded().lens;
        truths.emplace_back(lens.width, lens.height);
        ByteReader reader(piece);
        getRows(reader, 0, lens.height, truths.back());
    }
    return truths;
}

WayChart stepChart(ReportRun& run, const ReportScene& scene) {
    const VolumeScene& volume = colonOf(scene.loaded())->volume;
    const int frames = run.pick(2, 6), repeats = run.pick(3, 7);
    WayChart chart;
    chart.id = "casting/" + scene.id;
    chart.title = "Distance of samples, " + scene.title;
    chart.setting = fmt::format("{}, {} frames", run.settingOf(scene.loaded()), frames);
    chart.text = fmt::format(
        "Left eye; distance in the smallest spacing of voxels; error against samples 1/16 of it apart, {} "
        "repeats.",
        repeats);
    chart.timeLabel = "left eye, ms a frame";
    const std::vector<Plane<PackedColor>> truths = stepTruths(run, scene, frames);
    for (const double step : {0.125, 0.25, kDefaultStep, 1.0, 2.0, 4.0}) {
        std::vector<double> ms(static_cast<std::size_t>(repeats));
        double squares = 0, worst = 0;
        VolumeCasting casting;
        casting.stepVoxels = step;
        const VolumeRenderer renderer(volume, casting);
        for (int frame = 0; frame < frames; ++frame) {
            run.tell("casting, " + scene.title);
            const EyeView view = viewOf(scene, frame, frames);
            EyeImage image;
            image.resize(view.width, view.height, renderer.viewDependence());
            for (double& time : ms) {
                const Stopwatch watch;
                renderEye(renderer, view, image);
                time += watch.elapsed_ms() / frames;
            }
            const double rms = rmsOf(truths[static_cast<std::size_t>(frame)], image.color);
            squares += rms * rms / frames;
            worst = std::max(worst, rms);
        }
        chart.points.push_back(
            {{fmt::format("{:g}", step), spreadOf(ms), std::sqrt(squares), step == kDefaultStep},
             fmt::format("samples {:g} voxels apart", step),
             worst});
    }
    return chart;
}

struct Depths {
    std::vector<double> t;
    double ms = 0;
};

template <typename Caster>
Depths castDepths(const EyeView& view, const Caster& caster) {
    Depths depths{std::vector<double>(static_cast<std::size_t>(view.width) * view.height), 0};
    const Stopwatch watch;
    parallelFor(view.height, [&](int y) {
        for (int x = 0; x < view.width; ++x)
            depths.t[static_cast<std::size_t>(y) * view.width + x] =
                caster(view.rayDirection(x + 0.5, y + 0.5));
    });
    depths.ms = watch.elapsed_ms();
    return depths;
}

// Delay of hits as a share of the depth, and the share of pixels hit by one method only.
struct DepthError {
    double rms = 0, worst = 0, missed = 0;
};

DepthError depthError(const Depths& depths, const Depths& exact) {
    DepthError error;
    double count = 0, missed = 0;
    for (std::size_t n = 0; n < exact.t.size(); ++n) {
        if (std::isfinite(exact.t[n]) != std::isfinite(depths.t[n])) ++missed;
        if (!std::isfinite(exact.t[n]) || !std::isfinite(depths.t[n])) continue;
        const double off = std::abs(depths.t[n] / exact.t[n] - 1);
        error.rms += off * off;
        error.worst = std::max(error.worst, off);
        ++count;
    }
    error.rms = count > 0 ? std::sqrt(error.rms / count) : 0;
    error.missed = missed / static_cast<double>(std::max<std::size_t>(exact.t.size(), 1));
    return error;
}

WayPoint depthPoint(const std::string& name, const std::string& detail, const std::vector<double>& ns,
                    const DepthError& error, bool isDefault) {
    return {{name, spreadOf(ns), 100 * error.rms, isDefault},
            detail,
            100 * error.worst,
            {{"other hits %", 100 * error.missed}}};
}

WayChart terrainChart(ReportRun& run, const ReportScene& scene) {
    const Heightfield& ground = terrainOf(scene.loaded())->ground;
    const Scene& s = scene.loaded();
    Lens lens = s.lens;
    lens.width = run.pick(100, 200);
    lens.height = run.pick(80, 160);
    const EyeView view = makeEyeView(s.startPose, lens);
    const double pixels = static_cast<double>(lens.width) * lens.height;
    WayChart chart;
    chart.id = "casting/" + scene.id;
    chart.title = "Exact hits against stepping, " + scene.title;
    chart.setting = run.settingOf(s, lens);
    chart.text =
        "Nanoseconds a ray from the start pose. Stepped: the casting of Wan et al. 2004 in plain code, steps "
        "in sample spacings. Exact in plain code: cell by cell. Exact: the program's own, with its shading. "
        "Other hits: pixels where one of both met nothing.";
    chart.timeLabel = "ns a ray";
    chart.timeUnit = "ns";
    chart.errorLabel = "RMS error of the depth, %";
    chart.errorUnit = "%";
    const int repeats = run.pick(3, 7);
    const auto exactHit = [&](const glm::dvec3& d) {
        return castPlain(ground, view.eye, d, view.nearDepth, view.bend()).t;
    };
    const Depths exact = castDepths(view, exactHit);
    const auto times = [&](const auto& work) {
        std::vector<double> ns;
        for (int n = 0; n < repeats; ++n) {
            run.tell("casting, " + scene.title);
            ns.push_back(1e6 * work() / pixels);
        }
        return ns;
    };
    EyeImage image;
    image.resize(view.width, view.height, rendererOf(s).viewDependence());
    chart.points.push_back(depthPoint("exact", "vector code, with shading", times([&] {
                                          const Stopwatch watch;
                                          renderEye(rendererOf(s), view, image);
                                          return watch.elapsed_ms();
                                      }),
                                      {}, true));
    chart.points.push_back(depthPoint("exact in plain code", "cell by cell, hits alone",
                                      times([&] { return castDepths(view, exactHit).ms; }), {}, false));
    for (const double step : {0.25, 0.5, 1.0, 2.0}) {
        const double metres = step * ground.spacing().x;
        Depths depths;
        const std::vector<double> ns = times([&] {
            depths = castDepths(view, [&](const glm::dvec3& d) {
                return castEquidistant(ground, view.eye, d, view.nearDepth, metres, view.bend());
            });
            return depths.ms;
        });
        chart.points.push_back(depthPoint(fmt::format("stepped {:g}", step),
                                          fmt::format("steps of {:g} spacings", step), ns,
                                          depthError(depths, exact), false));
    }
    return chart;
}

// Compares both ways of making the same picture; they must agree in every pixel.
void addLeaping(ReportRun& run, ReportTable& table, const ReportScene& scene) {
    VolumeCasting walking;
    walking.leaping = false;
    const VolumeRenderer leaps(colonOf(scene.loaded())->volume),
        walks(colonOf(scene.loaded())->volume, walking);
    const EyeView view = viewOf(scene, 0, 2);
    EyeImage a, b;
    a.resize(view.width, view.height, leaps.viewDependence());
    b.resize(view.width, view.height, walks.viewDependence());
    std::vector<double> with, without;
    for (int n = 0; n < run.pick(3, 9); ++n) {
        run.tell("leaping, " + scene.title);
        Stopwatch watch;
        renderEye(leaps, view, a);
        with.push_back(watch.lap_ms());
        renderEye(walks, view, b);
        without.push_back(watch.lap_ms());
    }
    int other = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) other += a.viewDepth.at(x, y) != b.viewDepth.at(x, y);
    table.rows.push_back(
        {scene.title, spreadText(spreadOf(with)), spreadText(spreadOf(without)), std::to_string(other)});
}

}  // namespace

PeerBytes makeStepTruth(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<StepTruthOrder>();
    const ReportScene& scene = run.castScene(asked.scene);
    run.tell("casting, the truth of " + scene.title);
    const EyeView view = viewOf(scene, asked.frame, asked.frames);
    VolumeCasting casting;
    casting.stepVoxels = kFinestStep;
    const VolumeRenderer renderer(colonOf(scene.loaded())->volume, casting);
    EyeImage image;
    image.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, image);
    ByteWriter writer;
    putRows(writer, 0, view.height, image.color);
    return writer.take();
}

void reportCasting(ReportRun& run, double) {
    ReportSection section{"casting", "Casting rays", "", {}};
    ReportTable leaping{
        "Leaping over empty cells",
        "An exact pair: the same picture with and without, left eye. Pixels whose depths differ are counted.",
        {"scene", "leaping, ms", "cell by cell, ms", "pixels that differ"},
        {}};
    for (const ReportScene& scene : run.scenes()) {
        run.checkTime();
        if (terrainOf(scene.loaded())) addChart(run.report(), section, terrainChart(run, scene));
        if (terrainOf(scene.loaded())) addChart(run.report(), section, filteringChart(run, scene));
        if (!colonOf(scene.loaded())) continue;
        if (rendererOf(scene.loaded()).translucent())
            addChart(run.report(), section, stepChart(run, scene));
        else
            addLeaping(run, leaping, scene);
    }
    run.checkTime();
    addChart(run.report(), section, normalsChart(run));
    section.blocks.emplace_back(std::move(leaping));
    section.blocks.emplace_back(
        ReportText{"Fixed, with nothing to choose: opaque surfaces are met exactly (bilinear cells of "
                   "terrain, cubic hits in cells of volumes)."});
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
