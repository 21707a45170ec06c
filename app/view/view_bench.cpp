#include "app/view/view_bench.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "app/view/frame_views.h"
#include "app/view/late_view.h"
#include "engine/frame/sliced_frames.h"
#include "engine/metrics/image_difference.h"
#include "engine/metrics/supersampled_picture.h"

namespace stereonav {
namespace {

constexpr double kSettling = 2;  // seconds at rest before the flight, in which following eyes arrive
constexpr const char* kJudging = "judging";
constexpr std::size_t kSweptSamples = 4;  // samples of media per judged one, as a pair takes seconds
constexpr int kTruthSide = 8;             // 64 rays per pixel
constexpr int kMovingTruthSide = 4;       // 16 rays per pixel, for pictures in motion
constexpr int kSweptTruthSide = 2;        // for media, where a frame of so many rays takes seconds
constexpr double kTruthEffort = 4;        // multiple of the slices
constexpr double kMs = 1000;

// Returns the smallest value that such a share of them does not exceed; NaN for no values.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return std::nan("");
    std::sort(values.begin(), values.end());
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(rank - 1, 0.0))];
}

double meanOf(const std::vector<double>& values) {
    if (values.empty()) return std::nan("");
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

bool sameMoment(const FrameRequest& a, const FrameRequest& b) {
    return a.pose.position == b.pose.position && a.pose.orientation == b.pose.orientation &&
           a.time == b.time && a.lens.width == b.lens.width && a.lens.height == b.lens.height &&
           a.stereo.separation == b.stereo.separation && a.stereo.zeroParallax == b.stereo.zeroParallax;
}

// Squared errors of all channels, over all pictures.
class ErrorMean {
public:
    void add(const Plane<PackedColor>& truth, const ShownPicture::Eye& eye) {
        if (!eye || eye->empty() || eye->width() != truth.width() || eye->height() != truth.height()) return;
        const double psnr = errorOf(truth, *eye).psnr_db;
        mSum += psnr >= kIdenticalPsnr_db ? 0 : std::pow(10, -psnr / 10);
        ++mCount;
    }
    std::optional<double> psnr() const {
        if (mCount == 0) return std::nullopt;
        return mSum > 0 ? std::min(kIdenticalPsnr_db, -10 * std::log10(mSum / mCount)) : kIdenticalPsnr_db;
    }

private:
    double mSum = 0;
    int mCount = 0;
};

StereoViews viewsAt(FrameRequest request, const ShownPicture& picture) {
    request.lens.width = picture.left->width();
    request.lens.height = picture.left->height();
    return viewsOf(request);
}

void setLight(const Scene& scene, const FrameRequest& request) {
    if (auto* const light = scene.offered<TurningLight>()) light->turnTo(request.sun);
    if (auto* const effort = scene.offered<FrameEffort>()) effort->setEffort(1);
    if (auto* const models = scene.offered<LightModels>()) models->choose(request.model);
}

void addPair(const EyePair& pair, const ShownPicture& picture, ErrorMean& error) {
    error.add(pair.left.color, picture.left);
    if (picture.of.twoEyes) error.add(pair.right.color, picture.right);
}

// Adds the error of each eye against the scene's exact method.
void addExact(const Scene& scene, const FrameRequest& request, const ShownPicture& picture, EyePair& pair,
              ErrorMean& error) {
    setLight(scene, request);
    const StereoViews views = viewsAt(request, picture);
    if (request.twoEyes)
        scene.frames().make(views, request.time, {scene.frames().exactMethod(), {}}, pair);
    else
        scene.frames().makeOne(views.left, request.time, pair);
    addPair(pair, picture, error);
}

// Gives truths the detail of the picture that is compared.
void lookFrom(const Scene& scene, const StereoViews& views) {
    if (const auto* const rays = scene.offered<RayCast>()) rays->renderer->lookFrom(views.left, views.right);
}

Plane<PackedColor> fineEye(const Scene& scene, const EyeView& view, double time, Progress& progress,
                           int side = kTruthSide) {
    if (const auto* const rays = scene.offered<RayCast>())
        return renderSupersampled(*rays->renderer, view, side, progress);
    // One sweep is used, since each strip would sweep all of the light.
    EyePair fine;
    scene.frames().makeOne(view.supersampled(kSweptTruthSide), time, fine);
    Plane<PackedColor> mean(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            glm::vec3 sum(0.0f);
            for (int k = 0; k < kSweptTruthSide * kSweptTruthSide; ++k)
                sum += unpackColor(fine.left.color.at(kSweptTruthSide * x + k % kSweptTruthSide,
                                                      kSweptTruthSide * y + k / kSweptTruthSide));
            mean.at(x, y) = packColor(sum / static_cast<float>(kSweptTruthSide * kSweptTruthSide));
        }
    return mean;
}

// other: a picture of the same moment, or null.
void addFine(const Scene& scene, const ShownPicture& picture, ErrorMean& error, const ShownPicture* other,
             ErrorMean& ofOther, Progress& progress) {
    setLight(scene, picture.of);
    auto* const swept = dynamic_cast<SlicedFrames*>(&scene.frames());
    if (swept) swept->setEffort(kTruthEffort);
    const StereoViews views = viewsAt(picture.of, picture);
    lookFrom(scene, views);
    Progress ofLeft(progress, 0, picture.of.twoEyes ? 0.5 : 1), ofRight(progress, 0.5, 1);
    const Plane<PackedColor> left = fineEye(scene, views.left, picture.of.time, ofLeft);
    error.add(left, picture.left);
    if (other) ofOther.add(left, other->left);
    if (picture.of.twoEyes) {
        const Plane<PackedColor> right = fineEye(scene, views.right, picture.of.time, ofRight);
        error.add(right, picture.right);
        if (other) ofOther.add(right, other->right);
    }
    if (swept) swept->setEffort(1);
}

// Adds the error of cast pictures against more rays per pixel, which no method of making a pair casts.
void addMovingTruth(const Scene& scene, const ShownPicture& picture, ErrorMean& error, Progress& progress) {
    setLight(scene, picture.of);
    const StereoViews views = viewsAt(picture.of, picture);
    lookFrom(scene, views);
    Progress ofLeft(progress, 0, picture.of.twoEyes ? 0.5 : 1), ofRight(progress, 0.5, 1);
    error.add(fineEye(scene, views.left, picture.of.time, ofLeft, kMovingTruthSide), picture.left);
    if (picture.of.twoEyes)
        error.add(fineEye(scene, views.right, picture.of.time, ofRight, kMovingTruthSide), picture.right);
}

FactValue valueOf(const std::optional<double>& number) {
    return number ? FactValue(*number) : FactValue(std::nan(""));
}

}  // namespace

ViewBench::Wish ViewBench::step(double now, bool ready, bool flying, double duration) {
    switch (mStage) {
        case Stage::Wait:
            if (!ready) mReadySince = -1;
            if (ready && mReadySince < 0) mReadySince = now;
            if (!ready || now - mReadySince < kSettling) return Wish::None;
            mStage = Stage::Fly;
            mStarted = now;
            mDuration = mWhole ? duration : std::min(duration, kLongestFlight);
            return Wish::Fly;
        case Stage::Fly:
            if (flying && now - mStarted < mDuration) return Wish::None;
            mStage = Stage::Rest;
            mStopped = now;
            return flying ? Wish::Stop : Wish::None;
        case Stage::Rest:
            keepRest(now);
            if (now - mStopped < kRest) return Wish::None;
            mStage = Stage::Judge;
            return Wish::Judge;
        case Stage::Judge:
            break;
    }
    return Wish::None;
}

void ViewBench::keepRest(double now) {
    if (!mAfterOne && now - mStopped >= 1) mAfterOne = mNewest;
    if (!mAfterTen && now - mStopped >= 10) mAfterTen = mNewest;
}

void ViewBench::cast(const ViewFrame& frame) {
    if (mStage != Stage::Fly) return;
    const double scale = frame.request.scale * frame.request.effort;
    mSizeChanges += !mScale.empty() && mScale.back() != scale;
    mScale.push_back(scale);
    mGuard.push_back(areaOf(frame.request) - 1);
    mCast.push_back(frame.timings.both_ms);
    mCoarse += frame.lacksDetail;
}

void ViewBench::shown(const ShownPicture& picture, const FrameRequest& now, double at) {
    const bool isNew = !mNewest || !sameMoment(mNewest->of, picture.of) ||
                       mNewest->cast.version != picture.cast.version || mNewest->left != picture.left;
    if (!isNew) return;
    const bool isLater = !mNewest || !sameMoment(mNewest->of, picture.of);
    if (mStage == Stage::Rest) keepRest(at);
    mNewest = picture;
    if (mStage != Stage::Fly || !isLater) return;
    if (mLast >= 0) {
        mBetween.push_back(kMs * (at - mLast));
        mAge.push_back(kMs * std::abs(at - picture.cast.asked_s - picture.cast.ahead_s));
        mDelay.push_back(kMs * (at - picture.cast.asked_s));
        mShownAge.push_back(kMs * (at - picture.of.asked_s));
        mWarped += picture.warped;
        keepSample(picture, now, at);
    }
    mLast = at;
}

void ViewBench::keepSample(const ShownPicture& picture, const FrameRequest& now, double at) {
    const double next = mStarted + mDuration * (static_cast<double>(mSamples.size()) + 0.5) / kSamples;
    if (at >= next && static_cast<int>(mSamples.size()) < kSamples) mSamples.push_back({picture, now});
}

void ViewBench::judge(const Scene& scene, Progress& progress) {
    ErrorMean moving, movingTrue, present;
    if (auto* const detail = scene.offered<LateDetail>()) detail->waitForAll();
    EyePair pair;
    const bool fine = scene.offered<RayCast>() != nullptr;
    const std::size_t each = fine ? 1 : kSweptSamples;
    const double steps = std::ceil(static_cast<double>(mSamples.size()) / static_cast<double>(each)) + 1;
    progress.report(0, kJudging);
    for (std::size_t n = 0; n < mSamples.size(); n += each) {
        const Kept& kept = mSamples[n];
        const double step = static_cast<double>(n / each);
        Progress judging(progress, step / steps, (step + 1) / steps);
        judging.report(0, kJudging);
        ++mJudged;
        addExact(scene, kept.picture.of, kept.picture, pair, moving);
        if (fine) addMovingTruth(scene, kept.picture, movingTrue, judging);
        if (sameMoment(kept.now, kept.picture.of))
            addPair(pair, kept.picture, present);
        else
            addExact(scene, kept.now, kept.picture, pair, present);
    }
    mMovingPsnr = moving.psnr();
    mMovingTruePsnr = movingTrue.psnr();
    mNowPsnr = present.psnr();
    Progress rest(progress, (steps - 1) / steps, 1);
    judgeRest(scene, rest);
    progress.report(1, kJudging);
}

void ViewBench::judgeRest(const Scene& scene, Progress& progress) {
    if (!mAfterOne || !mAfterTen) return;
    ErrorMean one, ten, oneOfPair, tenOfPair;
    const bool swept = !scene.offered<RayCast>(), same = sameMoment(mAfterOne->of, mAfterTen->of);
    mTruthRays = swept ? kSweptTruthSide * kSweptTruthSide : kTruthSide * kTruthSide;
    mTruthEffort = swept ? kTruthEffort : 1;
    // One truth serves both, where nothing moved between them.
    Progress first(progress, 0, same ? 1 : 0.5), second(progress, 0.5, 1);
    addFine(scene, *mAfterOne, one, same ? &*mAfterTen : nullptr, ten, first);
    if (!same) addFine(scene, *mAfterTen, ten, nullptr, ten, second);
    mOnePsnr = one.psnr();
    mTenPsnr = ten.psnr();
    if (!swept) return;
    EyePair pair;
    addExact(scene, mAfterOne->of, *mAfterOne, pair, oneOfPair);
    if (same)
        addPair(pair, *mAfterTen, tenOfPair);
    else
        addExact(scene, mAfterTen->of, *mAfterTen, pair, tenOfPair);
    mOneOfPair = oneOfPair.psnr();
    mTenOfPair = tenOfPair.psnr();
}

Facts ViewBench::facts() const {
    FactList list;
    list.json("flight_s", mStopped - mStarted);
    list.json("pictures", static_cast<std::int64_t>(mBetween.size()));
    list.json("warped", static_cast<std::int64_t>(mWarped));
    list.json("cast", static_cast<std::int64_t>(mCast.size()));
    list.json("shown_p50_ms", quantile(mBetween, 0.5));
    list.json("shown_p95_ms", quantile(mBetween, 0.95));
    list.json("shown_p99_ms", quantile(mBetween, 0.99));
    list.json("age_p50_ms", quantile(mAge, 0.5));
    list.json("age_p95_ms", quantile(mAge, 0.95));
    list.json("delay_p95_ms", quantile(mDelay, 0.95));
    list.json("pose_age_p95_ms", quantile(mShownAge, 0.95));
    list.json("cast_coarse", static_cast<std::int64_t>(mCoarse));
    list.json("cast_p50_ms", quantile(mCast, 0.5));
    list.json("cast_p95_ms", quantile(mCast, 0.95));
    list.json("scale_mean", meanOf(mScale));
    list.json("size_changes", static_cast<std::int64_t>(mSizeChanges));
    list.json("guard_mean", meanOf(mGuard));
    list.json("judged", static_cast<std::int64_t>(mJudged));
    list.json("psnr_moving_db", valueOf(mMovingPsnr));
    if (mMovingTruePsnr) list.json("psnr_moving_true_db", *mMovingTruePsnr);
    list.json("psnr_now_db", valueOf(mNowPsnr));
    list.json("psnr_1s_db", valueOf(mOnePsnr));
    list.json("psnr_10s_db", valueOf(mTenPsnr));
    if (mOneOfPair) {
        list.json("psnr_1s_pair_db", valueOf(mOneOfPair));
        list.json("psnr_10s_pair_db", valueOf(mTenOfPair));
        list.json("rest_truth_effort", mTruthEffort);
    }
    list.json("rest_truth_rays", static_cast<std::int64_t>(mTruthRays));
    return list.facts();
}

}  // namespace stereonav
