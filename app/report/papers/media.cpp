// Kniss et al. 2003 beside this program: rates of the shading models by size (section 4, fig. 14), on the CPU
// and in GLSL, into one target or several (fig. 15; row K8 of docs/ledger.md).
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>

#include "app/report/papers/data.h"
#include "app/report/papers/gpu.h"
#include "app/report/papers/run.h"
#include "app/report/whole_medium.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/camera/default_eyes.h"
#include "engine/medium/model/built_in_media.h"
#include "engine/medium/sweep/medium_scene.h"
#include "engine/medium/sweep/medium_sweep.h"

namespace stereonav {
namespace {

constexpr const char* kKniss = "Kniss et al. 2003";
constexpr const char* kNoTime = "no time was left";
constexpr int kLeastSize = 256;  // side in pixels of the size that is measured even without time
constexpr std::array<MediumModel, 4> kPaperModels{MediumModel::Emission, MediumModel::Surface,
                                                  MediumModel::Direct, MediumModel::Indirect};

struct MediaSubject {
    std::string title;
    Medium medium, surface;  // `surface` shows the surface model: weight 1 everywhere
    MediumLook look;

    const Medium& of(MediumModel model) const { return model == MediumModel::Surface ? surface : medium; }
};

Medium mediumOf(std::shared_ptr<const GreyVolume> field, const char* preset, bool allSurfaces) {
    const MediumTransfer transfer = findMediumTransfer(preset);
    return Medium(std::move(field), allSurfaces ? allSurface(transfer) : transfer);
}

MediaSubject subjectOf(const PaperData& data) {
    const bool real = !data.find("ct/headsq/quarter.nhdr").empty();
    std::shared_ptr<const GreyVolume> field;
    std::string title = std::string("the generated cloud") + kStandsIn;
    if (real) {
        PaperVolume head = paperVolume(data, "ct/headsq/quarter.nhdr", "a human head in CT");
        title = head.title;
        field = std::make_shared<GreyVolume>(std::move(head.volume));
    } else {
        field = makeCloudField();
    }
    const char* preset = real ? "head" : "cloud";
    return {title, mediumOf(field, preset, false), mediumOf(field, preset, true), {}};
}

// Returns views of the whole medium, lit over the viewer's shoulder.
StereoViews viewsOf(MediaSubject& subject, int size) {
    const WholeMedium whole = wholeMedium(subject.medium, size);
    subject.look.light.direction = whole.light;
    return makeStereoViews(whole.pose, whole.lens, defaultEyes(SeenAs::Outside, whole.distance));
}

// Returns the paper's statement for a model, relative to the unshaded rate: "50 to 60 percent slower than
// volume rendering with no shading at all".
std::string saidOf(MediumModel model) {
    if (model == MediumModel::Emission) return "1";
    return model == MediumModel::Surface ? "comparable to volume shading" : "0.4 to 0.5";
}

class MediaTables {
public:
    MediaTables(ReportRun& run, const PaperData& data)
        : mRun(run), mSubject(subjectOf(data)), mSlices(run.quick() ? 64 : SweepSetting{}.slices) {}

    std::vector<PaperRow> rows(double seconds) {
        const Stopwatch watch;
        const std::vector<int> sizes = mRun.quick() ? std::vector<int>{64} : std::vector<int>{256, 512, 1024};
        // The shaders of a software rasteriser take longest.
        for (const int size : sizes) addOnProcessor(size, 0.4 * seconds, watch);
        addOnGpu(std::max(0.0, seconds - watch.elapsed_ms() / 1000));
        return std::move(mRows);
    }

private:
    using Times = std::array<std::array<Spread, 2>, kPaperModels.size()>;  // by model; for one and both eyes

    PaperRow& add(const char* table, const std::string& row, const std::string& column, const Spread& ours,
                  const char* unit, const std::string& said, const char* why, const std::string& where) {
        mRows.push_back({.paper = kKniss,
                         .table = table,
                         .row = row,
                         .column = column,
                         .said = said,
                         .ours = ours,
                         .unit = unit,
                         .measured = fmt::format("{}, {} slices, {}", mSubject.title, mSlices, where),
                         .why = why});
        return mRows.back();
    }

    SweepSetting setting() const {
        SweepSetting s;
        s.slices = mSlices;
        return s;
    }

    static Spread rateOf(const Spread& ms) {
        return ms.count ? Spread{1000 / ms.median, 1000 / ms.high, 1000 / ms.low, ms.count} : Spread{};
    }

    // Measures all models in turn in each repeat, so that changes in the machine's speed affect all equally.
    // The first repeat is not counted; at least one more is made, unless the time is over before.
    Times measureOnProcessor(int size, double seconds, const Stopwatch& watch) {
        MediumSweep plain(mSubject.medium), shaded(mSubject.surface);
        const StereoViews views = viewsOf(mSubject, size);
        const EyeView both[] = {views.left, views.right};
        std::array<std::array<std::vector<double>, 2>, kPaperModels.size()> ms;
        std::array<MediumPicture, 2> pictures;
        const auto late = [&] { return watch.elapsed_ms() > 1000 * seconds; };
        const bool skipped = late() && size > kLeastSize;
        for (int repeat = 0; repeat <= mRun.pick(2, 7) && !skipped; ++repeat) {
            if (repeat > 1 && late()) break;
            for (std::size_t m = 0; m < kPaperModels.size(); ++m)
                for (const std::size_t eyes : {1u, 2u}) {
                    mRun.tell(fmt::format("media, {} pixels", size));
                    MediumLook look = mSubject.look;
                    look.model = kPaperModels[m];
                    MediumSweep& sweep = look.model == MediumModel::Surface ? shaded : plain;
                    const Stopwatch one;
                    sweep.render(look, setting(), std::span(both).first(eyes), views.left.head, 0,
                                 std::span(pictures).first(eyes));
                    if (repeat > 0) ms[m][eyes - 1].push_back(one.elapsed_ms());
                }
        }
        Times times;
        for (std::size_t m = 0; m < kPaperModels.size(); ++m)
            for (std::size_t e = 0; e < 2; ++e) times[m][e] = spreadOf(ms[m][e]);
        return times;
    }

    void addOnProcessor(int size, double seconds, const Stopwatch& watch) {
        constexpr const char* kTable = "Section 4 and fig. 14, on the processor";
        constexpr const char* kWhyRate =
            "Fig. 14 is a chart of the CT carp on a GeForce 3 and a Radeon without figures in the text.";
        constexpr const char* kWhyShare =
            "The unshaded sweep skips empty space so well here that light and gradients weigh more beside "
            "it.";
        const Times times = measureOnProcessor(size, seconds, watch);
        const char* none = times[0][0].count ? "" : kNoTime;
        const std::string where = fmt::format("{} threads", threadCount());
        for (std::size_t m = 0; m < kPaperModels.size(); ++m) {
            const std::string name = fmt::format("{}, {}x{}", nameOf(kPaperModels[m]), size, size);
            for (std::size_t e = 0; e < 2; ++e) {
                const Spread& ms = times[m][e];
                add(kTable, name, e == 0 ? "one eye" : "both eyes", rateOf(ms), "pictures/s",
                    e == 0 ? "a chart" : "one eye alone", kWhyRate, where)
                    .none = none;
            }
            add(kTable, name, "rate, of the unshaded one", ratio(times[0][0], times[m][0]), "of 1",
                saidOf(kPaperModels[m]), kWhyShare, where)
                .none = none;
        }
    }

    void addOnGpu(double seconds) {
        constexpr const char* kTable = "Section 4 and fig. 15, in GLSL";
        constexpr const char* kWhy =
            "Theirs switched between OpenGL contexts, which was expensive; framebuffer objects cost next to "
            "nothing to switch between.";
        PaperGpu gpu;
        const std::string problem = gpu.problem(), where = gpu.renderer();
        const Stopwatch watch;
        for (const int size : mRun.quick() ? std::vector<int>{32} : std::vector<int>{256, 512}) {
            const StereoViews views = viewsOf(mSubject, size);
            Spread unshaded;
            for (const MediumModel model : kPaperModels) {
                const std::string name = fmt::format("{}, {}x{}", nameOf(model), size, size);
                Spread one, several;
                const bool late = watch.elapsed_ms() > 1000 * seconds && size > kLeastSize;
                if (problem.empty() && !late) {
                    one = timed(gpu, model, views.left, true);
                    several = timed(gpu, model, views.left, false);
                }
                if (model == MediumModel::Emission) unshaded = one;
                const std::string none = !problem.empty() ? problem : late ? kNoTime : "";
                const auto addRate = [&](const char* column, const Spread& ms) {
                    add(kTable, name, column, rateOf(ms), "pictures/s", "a chart", kWhy, where).none = none;
                };
                addRate("one target split by viewports", one);
                addRate("several targets", several);
                add(kTable, name, "several targets, time of one", ratio(several, one), "of 1",
                    "switching buffers can be very expensive", kWhy, where)
                    .none = none;
                add(kTable, name, "rate, of the unshaded one", ratio(unshaded, one), "of 1", saidOf(model),
                    "The shaders take every sample of a slice; a software rasteriser weighs arithmetic "
                    "otherwise than their cards.",
                    where)
                    .none = none;
            }
        }
    }

    static Spread ratio(const Spread& a, const Spread& b) {
        return a.count && b.count && b.low > 0 ? exactly(a.low / b.low) : Spread{};
    }

    Spread timed(PaperGpu& gpu, MediumModel model, const EyeView& view, bool singleTarget) {
        mRun.tell(fmt::format("media, GLSL, {}", nameOf(model)));
        MediumLook look = mSubject.look;
        look.model = model;
        SweepSetting s = setting();
        s.singleTarget = singleTarget;
        return gpu.time(mSubject.of(model), look, s, {&view, 1}, mRun.pick(1, 3));
    }

    ReportRun& mRun;
    MediaSubject mSubject;
    int mSlices;
    std::vector<PaperRow> mRows;
};

}  // namespace

void reportPapersMedia(ReportRun& run, double seconds) {
    const PaperData data(run.options().data);
    run.tell("media");
    ReportSection section{
        "papers-media", "Kniss et al. 2003: volume light", "A model for volume lighting and modeling.", {}};
    addPaperRows(run.report(), section, MediaTables(run, data).rows(seconds));
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
