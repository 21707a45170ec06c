// The report's part on the late warp: the error of an earlier picture that is warped to the present moment,
// against one cast now. By its age and by the speed of the scene's own flight, with turning and moving
// separately.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/report/run.h"
#include "app/report/trial.h"
#include "engine/image/image_file.h"
#include "engine/late/late_warp.h"
#include "engine/metrics/image_difference.h"

namespace stereonav {
namespace {

constexpr std::array<double, 6> kAges_ms{16, 33, 66, 133, 266, 400};

constexpr double kPicturedAge_ms = 133;

struct LateWay {
    const char *id, *name;
    double speed;  // multiple of the flight's own speed
    bool moves, turns;
};
constexpr std::array<LateWay, 5> kLateWays{{{"half", "half the speed", 0.5, true, true},
                                            {"own", "the flight's own speed", 1, true, true},
                                            {"twice", "twice the speed", 2, true, true},
                                            {"moved", "own speed, moved alone", 1, true, false},
                                            {"turned", "own speed, turned alone", 1, false, true}}};

constexpr std::size_t kPictured = 1;  // index of the way that is shown in pictures: own speed

// One way at one moment: frames of each age, warped to the present. The scene is one of run.scenes() or of
// its media.
struct LateOrder {
    bool medium, soft, pictures;
    std::size_t scene;
    double time;  // time of the flight
    EyeView now;
    std::array<EyeView, kAges_ms.size()> then;
};
struct LateWaySquares {
    std::array<double, kAges_ms.size()> of;  // squared errors by age
};

// Measures one eye: each eye is warped separately, by its own depths.
class LateTrial {
public:
    LateTrial(ReportRun& run, const ReportScene& scene, bool soft)
        : mRun(run), mReportScene(scene), mScene(scene.loaded()), mSoft(soft) {}

    // Measures as many moments as `seconds` allow, at least one.
    void run(int moments, double seconds) {
        mMoments = measureWhatFits(moments, seconds,
                                   [this](const std::vector<int>& some, int of) { measure(some, of); });
    }

    int moments() const { return mMoments; }
    // Returns the PSNR over all moments.
    double psnr(std::size_t way, std::size_t age) const {
        return -10 *
               std::log10(std::max(mSquares[way][age] / mMoments, std::pow(10, -0.1 * kIdenticalPsnr_db)));
    }
    const std::vector<ReportPicture>& pictures() const { return mPictures; }

private:
    EyeView viewAt(const Pose& pose) const { return mScene.viewsAt(pose).left; }

    // Returns the order of the n-th of `moments`.
    LateOrder orderOf(const LateWay& way, int n, int moments) const {
        const double share = (0.5 + (n + moments / 2) % moments) / moments;
        const RecordedPath& path = mScene.path;
        const double longest = 2 * kAges_ms.back() / 1000;
        const double time =
            std::min(longest + share * std::max(path.duration() - longest, 0.0), path.duration());
        const Pose now = path.at(path.startTime() + time);
        LateOrder order{mScene.offered<RayCast>() == nullptr,
                        mSoft,
                        &way == &kLateWays[kPictured] && n == 0,
                        mRun.indexOf(mReportScene),
                        time,
                        viewAt(now),
                        {}};
        for (std::size_t a = 0; a < kAges_ms.size(); ++a) {
            const Pose then =
                path.at(path.startTime() + std::max(time - way.speed * kAges_ms[a] / 1000, 0.0));
            Pose from = now;
            if (way.moves) from.position = then.position;
            if (way.turns) from.orientation = then.orientation;
            order.then[a] = viewAt(from);
        }
        return order;
    }

    void measure(const std::vector<int>& some, int moments) {
        std::vector<UntimedPiece> pieces;
        for (const int n : some)
            for (const LateWay& way : kLateWays)
                pieces.push_back(pieceOf(Untimed::LateWay, orderOf(way, n, moments)));
        const std::vector<PeerBytes> made = mRun.untimed().all(pieces);
        for (std::size_t n = 0; n < made.size(); ++n) {
            ByteReader reader(made[n]);
            const auto squares = reader.get<LateWaySquares>();
            for (std::size_t a = 0; a < kAges_ms.size(); ++a)
                mSquares[n % kLateWays.size()][a] += squares.of[a];
            if (reader.left() == 0) continue;
            mPictures = {{"cast 133 ms ago and warped to now", reader.getArray<unsigned char>()},
                         {"cast now", reader.getArray<unsigned char>()}};
        }
    }

    ReportRun& mRun;
    const ReportScene& mReportScene;
    const Scene& mScene;
    bool mSoft;
    std::array<std::array<double, kAges_ms.size()>, kLateWays.size()> mSquares{};
    std::vector<ReportPicture> mPictures;
    int mMoments = 0;
};

void chartLate(ReportRun& run, ReportSection& section, const ReportScene& scene, bool soft, double seconds) {
    LateTrial trial(run, scene, soft);
    trial.run(run.pick(1, 4), seconds);
    const std::string setting = fmt::format("{}, {} moments", run.settingOf(scene.loaded()), trial.moments());
    LineChart chart{{scene.title,
                     "age of the picture, ms",
                     "PSNR, dB",
                     ChartScale::Kind::Logarithmic,
                     ChartScale::Kind::Automatic,
                     {},
                     false},
                    fmt::format("{}: {}.", scene.title, setting)};
    ReportTable table{scene.title, "dB, by the age of the picture.", {"flown"}, {}};
    for (const double age : kAges_ms) table.columns.push_back(fmt::format("{:.0f} ms", age));
    for (std::size_t w = 0; w < kLateWays.size(); ++w) {
        ChartSeries series{kLateWays[w].name, {}, true};
        std::vector<std::string> row{kLateWays[w].name};
        for (std::size_t a = 0; a < kAges_ms.size(); ++a) {
            const double psnr = trial.psnr(w, a);
            series.points.push_back({"", spreadOf({kAges_ms[a]}), spreadOf({psnr}), false});
            row.push_back(fmt::format("{:.1f}", psnr));
            addFigure(run.report(),
                      {fmt::format("late/{}/{}/{:.0f}ms", scene.id, kLateWays[w].id, kAges_ms[a]), "dB",
                       setting, ReportFigure::Kind::Other, spreadOf({psnr})});
        }
        chart.chart.series.push_back(std::move(series));
        table.rows.push_back(std::move(row));
    }
    section.blocks.emplace_back(std::move(chart));
    section.blocks.emplace_back(std::move(table));
    section.blocks.emplace_back(ReportPictures{"An eighth of a second late, " + scene.title,
                                               "From the middle of the flight.", trial.pictures()});
}

}  // namespace

PeerBytes makeLateWay(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<LateOrder>();
    const ReportScene& scene = asked.medium ? run.medium(asked.scene) : run.castScene(asked.scene);
    run.tell("late warp, " + scene.title);
    const auto truth = run.untimed().kept<EyePair>(
        fmt::format("late {} {} {} {}", asked.medium, asked.scene, asked.time, asked.now.width), [&] {
            EyePair made;
            scene.frames().makeOne(asked.now, 0, made);
            return made;
        });
    EyePair cast;
    LateEye eye;
    Plane<PackedColor> warped, pictured;
    LateWaySquares squares{};
    for (std::size_t a = 0; a < kAges_ms.size(); ++a) {
        scene.frames().makeOne(asked.then[a], 0, cast);
        eye.prepare(cast.left.viewDepth, asked.then[a], scene.loaded().simd, asked.soft);
        eye.warp(cast.left.color, asked.now, warped, nullptr, true);
        squares.of[a] = std::pow(10, -0.1 * psnrOf(truth->left.color, warped));
        if (asked.pictures && kAges_ms[a] == kPicturedAge_ms) pictured = warped;
    }
    ByteWriter writer;
    writer.put(squares);
    if (asked.pictures)
        for (const Plane<PackedColor>* picture : {&pictured, &truth->left.color})
            writer.putArray(std::span<const unsigned char>(encodeColorImage(*picture, ".png")));
    return writer.take();
}

void reportLate(ReportRun& run, double seconds) {
    ReportSection section{
        "late",
        "The late warp",
        "In flight the window warps the newest picture to where the eyes are now. Here one that was "
        "cast some time ago is held against one cast now, of one eye, in one size. Frames are cast "
        "ahead of the moment that they are seen in, so that in the window a picture is off by less "
        "than it is old. What moves by itself stands still.",
        {}};
    const Stopwatch watch;
    std::vector<std::pair<const ReportScene*, bool>> all;
    for (const ReportScene& scene : run.scenes()) all.emplace_back(&scene, false);
    for (ReportScene& scene : run.media()) {
        scene.scene->lens.width = run.pick(100, 320);
        scene.scene->lens.height = run.pick(80, 256);
        all.emplace_back(&scene, scene.loaded().offered<FrameEffort>() != nullptr);
    }
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (all[n].first->loaded().path.samples().empty()) continue;  // nothing moves
        run.checkTime();
        const double left = std::max(0.0, seconds - watch.elapsed_ms() / 1000);
        chartLate(run, section, *all[n].first, all[n].second, left / static_cast<double>(all.size() - n));
    }
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
