// The report's charts of both eyes of media: one sweep, two, or splatted depths, by slices, size of the
// light's buffer and separation, against a sweep of many slices for each eye, on the media's own flights.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "app/report/felt_errors.h"
#include "app/report/run.h"
#include "engine/camera/default_eyes.h"
#include "engine/image/image_file.h"
#include "engine/medium/sweep/swept_frames.h"
#include "engine/metrics/image_difference.h"

namespace stereonav {
namespace {

struct PairWay {
    std::string name, detail;
    std::string_view method = kSweepMethod;
    SweepSetting sweep;
    bool isDefault = false;
};

std::vector<PairWay> waysOf(ReportRun& run, const SweepSetting& own) {
    std::vector<PairWay> ways;
    ways.reserve(kSweepMethods.size());
    for (const std::string_view method : kSweepMethods)
        ways.push_back(
            {std::string(method), fmt::format("{} slices", own.slices), method, own, method == kSweepMethod});
    SweepSetting changed = own;
    for (const int slices : run.brief() ? std::vector<int>{64} : std::vector<int>{32, 64, 128, 512}) {
        changed.slices = slices;
        if (slices != own.slices)
            ways.push_back(
                {fmt::format("sweep {} slices", slices), "both eyes in one", kSweepMethod, changed, false});
    }
    changed = own;
    for (const int size : run.brief() ? std::vector<int>{64} : std::vector<int>{64, 128, 512}) {
        changed.lightSize = size;
        if (size != own.lightSize)
            ways.push_back({fmt::format("sweep buffer {}", size),
                            fmt::format("{} slices, texels a side of the light's buffer", own.slices),
                            kSweepMethod, changed, false});
    }
    return ways;
}

double squareOf(const EyeImage& truth, const EyeImage& image) {
    const double psnr = psnrOf(truth.color, image.color);
    return psnr >= kIdenticalPsnr_db ? 0.0 : 255.0 * 255.0 * std::pow(10.0, -psnr / 10);
}

// A request for a frame's true pictures, of both eyes or the left one alone, each by a sweep of its own.
// scene: index into run.media().
struct SweptOrder {
    std::size_t scene;
    SweepSetting sweep;
    StereoViews views;
    double time;
    bool leftAlone;
};

void putEye(ByteWriter& writer, const EyeImage& eye) {
    putRows(writer, 0, eye.height(), eye.color);
    putRows(writer, 0, eye.height(), eye.viewDepth);
}
void getEye(ByteReader& reader, const EyeView& view, EyeImage& eye) {
    eye.resize(view.width, view.height);
    getRows(reader, 0, view.height, eye.color);
    getRows(reader, 0, view.height, eye.viewDepth);
}

// Measures frames of one medium. Holds their views and the true pictures of both eyes.
class PairTrial {
public:
    PairTrial(ReportRun& run, ReportScene& scene, int frames, double share)
        : mRun(run),
          mIndex(run.indexOf(scene)),
          mScene(*scene.scene),
          mTitle(scene.title),
          mOwn(scene.loaded().offered<MediumScene>()->sweep) {
        mScene.lens.width = run.pick(100, 320);
        mScene.lens.height = run.pick(80, 256);
        mScene.stereo.separation = mScene.stereo.zeroParallax * share;
        for (const Pose& pose : mScene.path.frames(frames)) mViews.push_back(mScene.viewsAt(pose));
        mNext = mScene.viewsAt(mScene.path.at(mScene.path.startTime() + kNextFrame_s));
        mFinest = mOwn;
        mFinest.shadingWidth = 0;
        mFinest.slices = run.pick(512, 2048);
    }

    // Finds the truths of all trials of a medium together, so that no process waits for another.
    static void findTruths(ReportRun& run, std::vector<PairTrial>& trials) {
        std::vector<UntimedPiece> pieces;
        for (const PairTrial& trial : trials)
            for (const StereoViews& views : trial.mViews)
                pieces.push_back(
                    pieceOf(Untimed::SweptTruth, SweptOrder{trial.mIndex, trial.mFinest, views, 0, false}));
        // Right eye of the frame that follows the first one.
        const PairTrial& first = trials.front();
        StereoViews next = first.mNext;
        next.left = next.right;
        pieces.push_back(
            pieceOf(Untimed::SweptTruth, SweptOrder{first.mIndex, first.mFinest, next, kNextFrame_s, true}));
        const std::vector<PeerBytes> made = run.untimed().all(pieces);
        auto piece = made.begin();
        for (PairTrial& trial : trials)
            for (const StereoViews& views : trial.mViews) {
                ByteReader reader(*piece++);
                EyePair& truth = trial.mTruths.emplace_back();
                getEye(reader, views.left, truth.left);
                getEye(reader, views.right, truth.right);
            }
        ByteReader reader(*piece);
        getEye(reader, next.left, trials.front().mNextTruth);
    }

    // Measures all ways in turn in each repeat, so that changes in the machine's speed affect all equally.
    std::vector<WayPoint> pointsOf(const std::vector<PairWay>& ways, int repeats) {
        mFirst.clear();
        std::vector<std::vector<double>> ms(ways.size(),
                                            std::vector<double>(static_cast<std::size_t>(repeats), 0.0));
        std::vector<WayPoint> points(ways.size());
        const auto frames = static_cast<double>(mViews.size());
        for (std::size_t n = 0; n < mViews.size(); ++n)
            for (std::size_t r = 0; r < static_cast<std::size_t>(repeats); ++r)
                for (std::size_t k = 0; k < ways.size(); ++k) {
                    ms[k][r] += sweep(ways[k].sweep, ways[k].method, mViews[n], 0, mFrame) / frames;
                    if (r == 0) addErrors(n, points[k]);
                    if (r == 0 && n == 0) mFirst.push_back({mFrame.left.color, mFrame.right.color});
                }
        for (std::size_t k = 0; k < ways.size(); ++k) {
            points[k].way = {ways[k].name, spreadOf(ms[k]), std::sqrt(points[k].way.error / (2 * frames)),
                             ways[k].isDefault};
            points[k].detail = ways[k].detail;
        }
        return points;
    }

    // Returns the errors of the first frame, as pointsOf() made it last, and of the next one.
    std::vector<FeltErrors> feltErrors(const std::vector<PairWay>& ways) {
        const StereoViews& views = mViews[0];
        EyePair nextFrame;
        const EyePair& exact = mTruths[0];
        const Plane<std::uint8_t> none(views.left.width, views.left.height);
        const FeltTruth truth{exact.left.color, exact.right.color, mNextTruth.color,
                              columnsInRightEye(views, exact.left.viewDepth, exact.right.viewDepth),
                              edgeMask(none, exact.right.viewDepth, views.parallaxScale, 2)};
        std::vector<FeltErrors> errors(ways.size());
        for (std::size_t k = 0; k < ways.size(); ++k) {
            sweep(ways[k].sweep, ways[k].method, mNext, kNextFrame_s, nextFrame);
            errors[k].add(truth, {mFirst[k].left, mFirst[k].right}, nextFrame.right.color);
        }
        return errors;
    }

    // Returns the right eye of the first frame, its truth, and the left eye.
    ReportPictures pictures() {
        sweep(mOwn, kSweepMethod, mViews[0], 0, mFrame);
        return {"Pictures, " + mTitle,
                "The first frame of the flight.",
                {{"left eye", encodeColorImage(mFrame.left.color, ".png")},
                 {"right eye, in the same sweep", encodeColorImage(mFrame.right.color, ".png")},
                 {fmt::format("right eye, a sweep of its own in {} slices", mFinest.slices),
                  encodeColorImage(mTruths[0].right.color, ".png")}}};
    }

    std::string setting() const {
        return fmt::format("{}, {} frames", mRun.settingOf(mScene), mViews.size());
    }
    int truthSlices() const { return mFinest.slices; }
    const SweepSetting& own() const { return mOwn; }

private:
    using Eye = EyeImage EyePair::*;
    struct Pictures {
        Plane<PackedColor> left, right;
    };

    template <typename Make>
    void with(const SweepSetting& setting, const Make& make) {
        mRun.tell("volume light in stereo, " + mTitle);
        mScene.offered<MediumScene>()->sweep = setting;
        make();
        mScene.offered<MediumScene>()->sweep = mOwn;
    }

    // Adds the frame's squares to the point's error.
    void addErrors(std::size_t frame, WayPoint& point) const {
        for (const Eye eye : {&EyePair::left, &EyePair::right}) {
            const double square = squareOf(mTruths[frame].*eye, mFrame.*eye);
            point.way.error += square;
            point.worstError = std::max(point.worstError, std::sqrt(square));
        }
    }

    double sweep(const SweepSetting& setting, std::string_view method, const StereoViews& views, double time,
                 EyePair& frame) {
        with(setting, [&] { mScene.frames().make(views, time, {method, {}}, frame); });
        return frame.timings.both_ms;
    }

    ReportRun& mRun;
    std::size_t mIndex;
    Scene& mScene;
    std::string mTitle;
    SweepSetting mOwn, mFinest;  // mFinest: for truths
    std::vector<StereoViews> mViews;
    StereoViews mNext;  // views of the second frame
    EyeImage mNextTruth;
    std::vector<EyePair> mTruths;
    EyePair mFrame;
    std::vector<Pictures> mFirst;  // pictures of the first frame, by ways
};

WayChart emptyChart(const PairTrial& trial) {
    WayChart chart;
    chart.setting = trial.setting();
    chart.timeLabel = "ms a frame, both eyes";
    return chart;
}

void addWaysCharts(ReportRun& run, ReportSection& section, const ReportScene& scene, PairTrial& trial,
                   int repeats) {
    const std::vector<PairWay> ways = waysOf(run, trial.own());
    WayChart chart = emptyChart(trial);
    chart.id = "pair/" + scene.id;
    chart.title = "Both eyes, " + scene.title;
    chart.text = fmt::format(
        "The mean frame of the medium's flight, eyes 1/30 of the zero-parallax distance apart, {} repeats; "
        "both eyes against a sweep of {} slices for each.",
        repeats, trial.truthSlices());
    chart.why =
        "The numbers of slices and of the buffer's texels are one choice for all media "
        "(docs/volume_light.md).";
    chart.points = trial.pointsOf(ways, repeats);
    WayChart felt = chart;
    felt.points.clear();
    felt.title = scene.title;
    felt.text = fmt::format(
        "Of the flight's first frame and the next one, against a sweep of {} slices for each eye; times are "
        "those of the chart of both eyes. What the measures are stands in the part on what a viewer feels.",
        trial.truthSlices());
    const std::vector<WayPoint> points = chart.points;
    addChart(run.report(), section, std::move(chart));
    addFeltCharts(run, section, scene.id, felt, points, trial.feltErrors(ways));
}

// Returns the chart of errors by separation. trials: one for each entry n of `parts`, with eyes 1/n of the
// zero-parallax distance apart.
WayChart separationsChart(ReportRun& run, const ReportScene& scene, const std::vector<int>& parts,
                          std::span<PairTrial> trials) {
    WayChart chart = emptyChart(trials.front());
    for (std::size_t n = 0; n < parts.size(); ++n) {
        const PairWay way{fmt::format("1/{}", parts[n]),
                          fmt::format("eyes 1/{} of the zero-parallax distance apart", parts[n]),
                          kSweepMethod, trials[n].own(), parts[n] == kUsualParts};
        chart.points.push_back(trials[n].pointsOf({way}, run.pick(2, 3)).front());
    }
    chart.id = "pair-separation/" + scene.id;
    chart.title = "Separations, " + scene.title;
    chart.text =
        "Both eyes in one sweep, from 1/1000 to 1/4 of the zero-parallax distance apart; the ring marks "
        "1/30. Bars upwards reach to the worse eye.";
    chart.front = false;
    return chart;
}

}  // namespace

PeerBytes makeSweptTruth(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<SweptOrder>();
    ReportScene& scene = run.medium(asked.scene);
    run.tell("volume light in stereo, the truth of " + scene.title);
    MediumScene& medium = *scene.scene->offered<MediumScene>();
    const SweepSetting own = medium.sweep;
    medium.sweep = asked.sweep;
    EyePair frame;
    if (asked.leftAlone)
        scene.frames().makeOne(asked.views.left, asked.time, frame);
    else
        scene.frames().make(asked.views, asked.time, {kTwoSweepsMethod, {}}, frame);
    medium.sweep = own;
    ByteWriter writer;
    putEye(writer, frame.left);
    if (!asked.leftAlone) putEye(writer, frame.right);
    return writer.take();
}

void reportPairs(ReportRun& run, ReportSection& section) {
    for (ReportScene& scene : run.media()) {
        run.checkTime();
        const std::vector<int> parts =
            run.brief() ? std::vector<int>{8} : std::vector<int>{1000, 120, kUsualParts, 8, 4};
        std::vector<PairTrial> trials;
        trials.emplace_back(run, scene, run.pick(1, 3), kUsualShare);
        for (const int part : parts) trials.emplace_back(run, scene, 1, 1.0 / part);
        PairTrial::findTruths(run, trials);
        addWaysCharts(run, section, scene, trials.front(), run.pick(2, 3));
        section.blocks.emplace_back(trials.front().pictures());
        addChart(run.report(), section, separationsChart(run, scene, parts, std::span(trials).subspan(1)));
    }
}

}  // namespace stereonav
