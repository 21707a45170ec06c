// The report's part on visible errors: flicker from frame to frame, rivalry between the eyes, and
// Butteraugli, for every way of making the right eye.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/felt_errors.h"
#include "app/report/fine_pictures.h"
#include "app/report/trial.h"
#include "engine/image/image_file.h"
#include "engine/metrics/butteraugli.h"
#include "engine/metrics/image_difference.h"

namespace stereonav {
namespace {

// Returns the methods to compare; in a brief report only those at their default settings.
std::vector<Variant> feltVariants(const Scene& scene, bool brief) {
    std::vector<Variant> variants = rightEyeVariants(scene);
    if (brief) std::erase_if(variants, [](const Variant& v) { return !v.detail.empty(); });
    return variants;
}

// Times and views of a frame of the flight, and of the next one.
struct FeltTimes {
    double time, nextTime;
    StereoViews views, next;
};

FeltTimes feltTimes(const Scene& scene, double time) {
    const auto viewsAt = [&](double at) {
        return makeStereoViews(scene.path.at(scene.path.startTime() + at), scene.lens, chartedEyes(scene));
    };
    return {time, time + kNextFrame_s, viewsAt(time), viewsAt(time + kNextFrame_s)};
}

// Full casts of a frame and of the next one: every way starts from them and is compared with them.
struct FeltMoment {
    EyePair exact, exactNext;
    FeltTruth truth;  // its pictures arrive with the order
};

FeltMoment momentAt(const ReportScene& scene, const FeltTimes& times) {
    FeltMoment moment;
    FrameMaker& frames = scene.frames();
    const StereoViews& views = times.views;
    frames.make(views, times.time, {frames.exactMethod(), {}}, moment.exact);
    frames.make(times.next, times.nextTime, {frames.exactMethod(), {}}, moment.exactNext);
    const Plane<float>&left = moment.exact.left.viewDepth, &right = moment.exact.right.viewDepth;
    moment.truth.columns = columnsInRightEye(views, left, right);
    EyeImage made;
    scene.rightFromLeft().makeRight(views, moment.exact.left, {frames.defaultMethod(), {}}, made);
    moment.truth.edges = edgeMask(scene.rightFromLeft().holes().mask, right, views.parallaxScale, 2);
    return moment;
}

// An order to measure one way at one moment. The message continues with the true pictures of the left eye,
// the right eye, and the next frame's right eye.
struct FeltOrder {
    std::size_t scene, variant;
    double time;
    bool brief, pictures;
};

// Measures frames of one scene's flight, each together with the next one.
class FeltTrial {
public:
    FeltTrial(ReportRun& run, const ReportScene& scene, const std::vector<Variant>& variants)
        : mRun(run),
          mReportScene(scene),
          mScene(scene.loaded()),
          mVariants(variants),
          mErrors(variants.size()),
          mFactor(run.pick(2, 8)),
          mBrief(run.brief()) {}

    // Measures as many frames as `seconds` allow, at least one: each in the middle of an equal part of the
    // flight.
    void run(int frames, double seconds) {
        mFrames = measureWhatFits(frames, seconds,
                                  [this](const std::vector<int>& some, int of) { measure(some, of); });
    }

    const std::vector<FeltErrors>& errors() const { return mErrors; }
    const std::vector<ReportPicture>& pictures() const { return mPictures; }
    int frames() const { return mFrames; }
    int rays() const { return mFactor * mFactor; }

private:
    // Returns the time of a frame; the first one is in the middle of the flight.
    double timeOf(int n, int frames) const {
        const double share = (0.5 + static_cast<double>((n + frames / 2) % frames)) / frames;
        return std::max(0.0, share * (mScene.path.duration() - kNextFrame_s));
    }

    void measure(const std::vector<int>& some, int frames) {
        std::vector<FineView> eyes;
        for (const int n : some) {
            const FeltTimes times = feltTimes(mScene, timeOf(n, frames));
            eyes.push_back({times.views.left, times.time});
            eyes.push_back({times.views.right, times.time});
            eyes.push_back({times.next.right, times.nextTime});
        }
        const std::vector<Plane<PackedColor>> truths = finePictures(mRun, mReportScene, eyes, mFactor);
        std::vector<UntimedPiece> pieces;
        for (std::size_t n = 0; n < some.size(); ++n)
            for (std::size_t k = 0; k < mVariants.size(); ++k) {
                ByteWriter order;
                order.put(FeltOrder{mRun.indexOf(mReportScene), k, timeOf(some[n], frames), mBrief,
                                    some[n] == 0 && mVariants[k].isDefault});
                for (std::size_t p = 3 * n; p < 3 * n + 3; ++p)
                    putRows(order, 0, truths[p].height(), truths[p]);
                pieces.push_back({Untimed::FeltWay, order.take()});
            }
        const std::vector<PeerBytes> made = mRun.untimed().all(pieces);
        for (std::size_t n = 0; n < made.size(); ++n) take(made[n], mErrors[n % mVariants.size()], truths);
    }

    void take(const PeerBytes& piece, FeltErrors& errors, const std::vector<Plane<PackedColor>>& truths) {
        ByteReader reader(piece);
        errors.add(reader.get<FeltErrors>());
        if (reader.left() == 0) return;
        mPictures = {{"right eye, the default way", reader.getArray<unsigned char>()},
                     {"the truth", encodeColorImage(truths[1], ".png")},
                     {"Butteraugli: black 0, grey 1, white 2 and more", reader.getArray<unsigned char>()}};
    }

    ReportRun& mRun;
    const ReportScene& mReportScene;
    const Scene& mScene;
    const std::vector<Variant>& mVariants;
    std::vector<FeltErrors> mErrors;
    std::vector<ReportPicture> mPictures;  // pictures of the first frame, by the default way
    int mFactor, mFrames = 0;
    bool mBrief;
};

void chart(ReportRun& run, ReportSection& section, const ReportScene& scene, double seconds) {
    const std::vector<Variant> variants = feltVariants(scene.loaded(), run.brief());
    FeltTrial felt(run, scene, variants);
    felt.run(run.pick(1, 4), 0.6 * seconds);
    RightEyeTrial times(scene, chartedEyes(scene.loaded()), variants);
    times.run(run, "times, " + scene.title, run.pick(1, 6), 0.3 * seconds);
    WayChart frame;
    frame.title = scene.title;
    frame.setting = fmt::format("{}, {} frames", run.settingOf(scene.loaded()), felt.frames());
    frame.text = fmt::format(
        "Against {} rays a pixel. Eyes 1/30 of the zero-parallax distance apart; times are the mean frame's "
        "of the scene's flight. A number after a method's name is a setting other than its default.",
        felt.rays());
    frame.why =
        "One ray a pixel flickers and differs between the eyes by itself, full casts too: ways nearer to "
        "each other than that are chosen by their error against the full cast.";
    frame.timeLabel = "right eye, ms a frame";
    addFeltCharts(run, section, scene.id, frame, times.points(), felt.errors());
    section.blocks.emplace_back(ReportPictures{"What would be noticed, " + scene.title,
                                               "From the middle of the flight.", felt.pictures()});
}

}  // namespace

PeerBytes makeFeltWay(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<FeltOrder>();
    const ReportScene& scene = run.castScene(asked.scene);
    run.tell("what is felt, " + scene.title);
    const FeltTimes times = feltTimes(scene.loaded(), asked.time);
    const StereoViews& views = times.views;
    const auto moment = run.untimed().kept<FeltMoment>(fmt::format("felt {} {}", asked.scene, asked.time),
                                                       [&] { return momentAt(scene, times); });
    FeltTruth& truth = moment->truth;
    for (Plane<PackedColor>* picture : {&truth.left, &truth.right, &truth.rightNext}) {
        picture->resize(views.right.width, views.right.height);
        getRows(order, 0, views.right.height, *picture);
    }
    const WarpSetting setting = feltVariants(scene.loaded(), asked.brief).at(asked.variant).setting;
    EyeImage right, rightNext;
    scene.rightFromLeft().makeRight(views, moment->exact.left, wayOf(setting), right);
    scene.rightFromLeft().makeRight(times.next, moment->exactNext.left, wayOf(setting), rightNext);
    FeltErrors errors;
    const Plane<float> map = errors.add(truth, {moment->exact.left.color, right.color}, rightNext.color);
    ByteWriter writer;
    writer.put(errors);
    if (asked.pictures) {
        writer.putArray(std::span<const unsigned char>(encodeColorImage(right.color, ".png")));
        writer.putArray(std::span<const unsigned char>(encodeColorImage(pictureOf(map), ".png")));
    }
    return writer.take();
}

void reportFelt(ReportRun& run, double seconds) {
    ReportSection section{
        "felt",
        "What a viewer feels",
        "Flicker: how far the right eye's change over a 30th of a second is from the truth's change. "
        "Rivalry: how far the two eyes differ, at points that both see, from how their truths differ. "
        "Butteraugli: how much of the right eye's error a person would notice, by libjxl, white at 80 cd/m2; "
        "at 1 a flip between picture and truth is just noticed.",
        {}};
    const Stopwatch watch;
    for (const ReportScene& scene : run.scenes()) {
        if (scene.loaded().path.samples().empty()) continue;  // nothing moves
        run.checkTime();
        const auto left = static_cast<double>(run.scenes().data() + run.scenes().size() - &scene);
        chart(run, section, scene, std::max(0.0, seconds - watch.elapsed_ms() / 1000) / left);
    }
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
