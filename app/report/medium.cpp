// The report's part on volume light: the sweep by slices, size of the light's buffer and cone, against path
// tracing through the medium and against the same model in many more slices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/trial.h"
#include "app/report/whole_medium.h"
#include "engine/base/parallel.h"
#include "engine/medium/model/built_in_media.h"
#include "engine/medium/model/medium_transfer.h"
#include "engine/medium/paths/delta_tracking.h"
#include "engine/medium/paths/delta_tracking_bounds.h"
#include "engine/medium/sweep/medium_sweep.h"

namespace stereonav {
namespace {

struct MediumSubject {
    std::string name;
    Medium medium;
    MediumLook look;
    EyeView view;
};

// Returns the preset without surfaces, which the path tracer does not know: their weights are 0.
MediumTransfer withoutSurface(const char* preset) {
    const MediumTransfer transfer = findMediumTransfer(preset);
    std::vector<MediumPoint> points = transfer.points();
    for (MediumPoint& p : points) p.material.surface = 0;
    return MediumTransfer(points, transfer.referenceLength(), preset);
}

MediumSubject subjectOf(const std::string& name, Medium medium, int size) {
    MediumSubject subject{name, std::move(medium), {}, {}};
    const WholeMedium whole = wholeMedium(subject.medium, size);
    subject.view = makeEyeView(whole.pose, whole.lens);
    subject.look.light.direction = whole.light;
    return subject;
}

MediumSubject subjectNamed(const std::string& name, int size) {
    return name == "wax"
               ? subjectOf(name, Medium(makeWaxField(), withoutSurface("wax")), size)
               : subjectOf(name, Medium(makeCloudField(), withoutSurface("cloud"), cloudPerturbation()),
                           size);
}

// The subject that pieces of truths are made from: wax, or else the cloud.
struct MediumOrder {
    bool wax;
    int size;
};
struct TrackedOrder {
    MediumOrder subject;
    MediumModel model;
    TrackingSetting tracking;
    PictureRows rows;
};
struct SlicesOrder {
    MediumOrder subject;
    int slices;
};

// A subject with the extinction bounds that its paths need.
struct TrackedSubject {
    MediumSubject subject;
    ExtinctionBounds bounds;
};

std::shared_ptr<TrackedSubject> keptSubject(ReportRun& run, const MediumOrder& order) {
    const std::string name = order.wax ? "wax" : "cloud";
    run.tell("volume light, the truth of " + name);
    return run.untimed().kept<TrackedSubject>(fmt::format("medium {} {}", name, order.size), [&] {
        MediumSubject subject = subjectNamed(name, order.size);
        ExtinctionBounds bounds = makeExtinctionBounds(subject.medium, 0);
        return TrackedSubject{std::move(subject), std::move(bounds)};
    });
}

struct SweepWay {
    std::string name, detail;
    SweepSetting setting;
    bool isDefault = false;
};

std::vector<SweepWay> waysOf(ReportRun& run, bool indirect) {
    std::vector<SweepWay> ways{{"256 slices", "256 slices, light's buffer 256, cone 0.6", {}, true}};
    const auto add = [&](const std::string& name, const SweepSetting& setting) {
        ways.push_back({name,
                        fmt::format("{} slices, light's buffer {}, cone {:g}", setting.slices,
                                    setting.lightSize, setting.coneAngle),
                        setting, false});
    };
    SweepSetting setting;
    for (const int slices :
         run.brief() ? std::vector<int>{64, 1024} : std::vector<int>{32, 64, 128, 512, 1024}) {
        setting.slices = slices;
        add(fmt::format("{} slices", slices), setting);
    }
    setting = {};
    for (const int size : run.brief() ? std::vector<int>{64} : std::vector<int>{32, 64, 128, 512}) {
        setting.lightSize = size;
        add(fmt::format("buffer {}", size), setting);
    }
    setting = {};
    if (indirect)
        for (const double cone :
             run.brief() ? std::vector<double>{0.0, 1.2} : std::vector<double>{0.0, 0.3, 1.2, 2.0}) {
            setting.coneAngle = cone;
            add(fmt::format("cone {:g}", cone), setting);
        }
    return ways;
}

WayChart sweepChart(ReportRun& run, const MediumSubject& subject, const MediumLook& look,
                    const Plane<PackedColor>& truth) {
    WayChart chart;
    chart.timeLabel = "ms a picture";
    chart.setting = run.settingOf(subject.view.width, subject.view.height);
    MediumSweep sweep(subject.medium);
    for (const SweepWay& way : waysOf(run, look.model == MediumModel::Indirect)) {
        std::vector<double> ms;
        MediumPicture picture;
        for (int n = 0; n < run.pick(2, 5); ++n) {
            run.tell("volume light, " + subject.name);
            const Stopwatch watch;
            sweep.render(look, way.setting, {&subject.view, 1}, subject.view.head, 0, {&picture, 1});
            ms.push_back(watch.elapsed_ms());
        }
        const double rms = rmsOf(truth, shown(picture.light));
        chart.points.push_back({{way.name, spreadOf(ms), rms, way.isDefault}, way.detail, rms});
    }
    return chart;
}

// Returns the standard error of the mean of a pixel, in linear light.
double truthNoise(const TrackedPicture& tracked) {
    double sum = 0;
    for (int y = 0; y < tracked.variance.height(); ++y)
        for (int x = 0; x < tracked.variance.width(); ++x) {
            const glm::vec3 v = tracked.variance.at(x, y);
            sum += (v.x + v.y + v.z) / 3;
        }
    return std::sqrt(sum / std::max(1, tracked.variance.width() * tracked.variance.height()));
}

struct PathTruth {
    MediumModel model;
    TrackingSetting tracking;
    TrackedPicture picture;
};
struct MediumTruths {
    std::vector<PathTruth> paths;
    int slices = 0;
    Plane<glm::vec4> manySlices;
};

// Finds all truths of a subject together, so that no process waits for another.
MediumTruths truthsOf(ReportRun& run, const MediumSubject& subject) {
    constexpr int kRows = 4;  // rows of a piece
    const EyeView& view = subject.view;
    const MediumOrder order{subject.name == "wax", view.height};
    MediumTruths truths;
    truths.slices = run.pick(2048, 8192);
    std::vector<UntimedPiece> pieces{pieceOf(Untimed::ManySlices, SlicesOrder{order, truths.slices})};
    for (const MediumModel model : {MediumModel::Direct, MediumModel::Indirect}) {
        TrackingSetting tracking;
        tracking.samples = run.pick(64, 512);
        tracking.mostScatters = model == MediumModel::Direct ? 1 : 64;
        tracking.seed = static_cast<std::uint32_t>(run.options().seed);
        truths.paths.push_back({model, tracking, {{view.width, view.height}, {view.width, view.height}}});
        for (int y = 0; y < view.height; y += kRows)
            pieces.push_back(
                pieceOf(Untimed::TrackedRows,
                        TrackedOrder{order, model, tracking, {y, std::min(view.height, y + kRows)}}));
    }
    const std::vector<PeerBytes> made = run.untimed().all(pieces);
    auto piece = made.begin();
    truths.manySlices = Plane<glm::vec4>(view.width, view.height);
    ByteReader slices(*piece++);
    getRows(slices, 0, view.height, truths.manySlices);
    for (PathTruth& truth : truths.paths)
        for (int y = 0; y < view.height; y += kRows) {
            ByteReader reader(*piece++);
            const int end = std::min(view.height, y + kRows);
            getRows(reader, y, end, truth.picture.light);
            getRows(reader, y, end, truth.picture.variance);
        }
    return truths;
}

void againstPaths(ReportRun& run, ReportSection& section, const MediumSubject& subject,
                  const PathTruth& truth) {
    const MediumModel model = truth.model;
    const TrackedPicture& tracked = truth.picture;
    MediumLook look = subject.look;
    look.model = model;
    WayChart chart = sweepChart(run, subject, look, shown(tracked.light));
    const std::string words = model == MediumModel::Direct ? "direct light" : "direct and indirect light";
    chart.id = fmt::format("medium/{}/{}", subject.name, nameOf(model));
    chart.title = fmt::format("Volume light, {}, {}", subject.name, words);
    chart.text = fmt::format(
        "The {} sweep of the program's own {}, on the CPU; against paths traced through it ({}), {} a pixel, "
        "whose own standard error is {} in linear light. The model is an approximation: more slices come "
        "nearer to the model, not to the truth.",
        words, subject.name, model == MediumModel::Direct ? "scattered once" : "all orders",
        truth.tracking.samples, numberText(truthNoise(tracked)));
    if (model == MediumModel::Indirect)
        chart.why =
            "The cone is a matter of the medium and of the light's way: what is best here need not be best "
            "elsewhere.";
    addChart(run.report(), section, std::move(chart));
}

void againstManySlices(ReportRun& run, ReportSection& section, const MediumSubject& subject,
                       const MediumTruths& truth) {
    WayChart chart = sweepChart(run, subject, subject.look, shown(truth.manySlices));
    std::erase_if(chart.points, [](const WayPoint& p) {
        return !p.way.isDefault && p.way.name.find("slices") == std::string::npos;
    });
    chart.id = fmt::format("medium/{}/slices", subject.name);
    chart.title = fmt::format("Volume light, {}, slices", subject.name);
    chart.text = fmt::format("Direct and indirect light against the same model in {} slices.", truth.slices);
    addChart(run.report(), section, std::move(chart));
}

}  // namespace

PeerBytes makeTrackedRows(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<TrackedOrder>();
    const auto kept = keptSubject(run, asked.subject);
    const MediumSubject& subject = kept->subject;
    MediumLook look = subject.look;
    look.model = asked.model;
    const TrackedPicture tracked =
        trackRows(subject.medium, kept->bounds, look, subject.view, asked.tracking, 0, asked.rows);
    ByteWriter writer;
    putRows(writer, asked.rows.first, asked.rows.end, tracked.light);
    putRows(writer, asked.rows.first, asked.rows.end, tracked.variance);
    return writer.take();
}

PeerBytes makeManySlices(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<SlicesOrder>();
    const auto kept = keptSubject(run, asked.subject);
    const MediumSubject& subject = kept->subject;
    SweepSetting finest;
    finest.slices = asked.slices;
    finest.shadingWidth = 0;
    MediumPicture picture;
    MediumSweep sweep(subject.medium);
    sweep.render(subject.look, finest, {&subject.view, 1}, subject.view.head, 0, {&picture, 1});
    ByteWriter writer;
    putRows(writer, 0, picture.light.height(), picture.light);
    return writer.take();
}

void reportMedium(ReportRun& run, double) {
    ReportSection section{
        "volume-light", "Volume light", "Light swept through translucent media, slice by slice.", {}};
    const int size = run.pick(48, 128);
    std::vector<MediumSubject> subjects;
    subjects.push_back(subjectNamed("cloud", size));
    if (!run.brief()) subjects.push_back(subjectNamed("wax", size));
    for (const MediumSubject& subject : subjects) {
        run.checkTime();  // checked before the truths, which take longest
        const MediumTruths truths = truthsOf(run, subject);
        for (const PathTruth& truth : truths.paths) againstPaths(run, section, subject, truth);
        againstManySlices(run, section, subject, truths);
    }
    run.checkTime();
    addChart(run.report(), section, shadingWidthChart(run));
    reportPairs(run, section);
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
