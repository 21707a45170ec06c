#include "app/scene/ground_painting.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/options/option_numbers.h"
#include "app/options/paint_words.h"
#include "app/scene/ground_paint.h"
#include "app/scene/ground_paint_survey.h"
#include "app/scene/ground_paint_tracks.h"
#include "engine/base/error.h"
#include "engine/base/lone_loops.h"
#include "engine/base/parallel.h"
#include "engine/base/thread_priority.h"
#include "terrain/scene/slope_color.h"

namespace stereonav {
namespace {

GroundPaintOptions contourOptions(const std::string& text) {
    GroundPaintOptions options;
    if (text.empty()) return options;
    const GivenNumbers given = numbersIn("--contours", contourNumbers(), text);
    options.contoursAuto = given.word == kAutoContours;
    if (!given.numbers.empty()) options.contours_m = given.numbers.front();
    return options;
}

std::string contourText(const SceneOptions& options) {
    if (options.ground.contoursAuto) return kAutoContours;
    const std::string given = options.given.text("contours");
    if (!given.empty() || !options.ground.contours_m) return given;
    return fmt::format("{:.6g}", *options.ground.contours_m);
}

}  // namespace

const std::array<const char*, GroundPainting::kLayers> GroundPainting::kKeys{"paint", "contours", "tracks"};

GroundPainting::GroundPainting(const TerrainScene& terrain, const Fog& fog, const SceneOptions& options,
                               SurfacePaint& paint)
    : mTerrain(terrain),
      mFog(fog),
      mOptions(options),
      mPaint(paint),
      mTinted(groundPaintOf(options) != GroundPaint::None),
      mLegend(std::make_shared<PaintLegend>()) {}

GroundPainting::~GroundPainting() {
    cancel();
    if (mThread.joinable()) mThread.join();
}

GroundPainting::Layer GroundPainting::layerOf(const std::string& key) {
    for (const Layer layer : {kPaint, kContours, kTracks})
        if (key == kKeys[layer]) return layer;
    return kLayers;
}

void GroundPainting::paintAll(Progress& progress) {
    const std::string tracks = mOptions.ground.tracks, contours = contourText(mOptions);
    for (const auto& [layer, text] :
         {std::pair(kPaint, mOptions.paint), std::pair(kContours, contours), std::pair(kTracks, tracks)}) {
        Painted made = painted(layer, {text, {}}, progress);
        const std::lock_guard lock(mMutex);
        show(layer, std::move(made));
    }
    mSurvey.reset();  // a picture needs no other
    takeUp();
}

bool GroundPainting::takes(const std::string& key, const std::string& text) const {
    const Layer layer = layerOf(key);
    if (layer != kPaint) return layer != kLayers;
    return !mTinted && (text.empty() || surveyed(text));
}

std::string GroundPainting::now(const std::string& key) const {
    const Layer layer = layerOf(key);
    if (layer == kLayers) return "";
    const std::lock_guard lock(mMutex);
    const std::optional<Wish>& wish = mWishes[layer];
    return wish && !wish->seenFrom ? wish->text : mShown[layer].text;
}

void GroundPainting::ask(const std::string& key, const std::string& text) {
    const Layer layer = layerOf(key);
    if (layer == kLayers || text == now(key)) return;
    if (layer != kContours && !text.empty()) return wish(layer, {text, {}});
    Progress quiet;
    Painted made = painted(layer, {text, {}}, quiet);  // at once
    const std::lock_guard lock(mMutex);
    ++mNumbers[layer];
    mWishes[layer].reset();
    if (mAtWork == layer) drop();
    show(layer, std::move(made));
}

void GroundPainting::askSeenFrom(const glm::dvec2& place, double height) {
    wish(kPaint, {"", SeenFrom{place, height}});
}

void GroundPainting::wish(Layer layer, Wish wish) {
    {
        const std::lock_guard lock(mMutex);
        ++mNumbers[layer];
        mWishes[layer] = std::move(wish);
        if (mAtWork == layer) drop();
        if (std::exchange(mWorks, true)) return;
    }
    if (mThread.joinable()) mThread.join();  // it has nothing left to do
    mThread = std::thread([this] { workOff(); });
}

void GroundPainting::cancel() {
    const std::lock_guard lock(mMutex);
    for (auto& wish : mWishes) wish.reset();
    drop();
}

void GroundPainting::drop() {
    if (!mProgress) return;
    mProgress->cancel();
    mDrop = true;
}

std::optional<PaintWork> GroundPainting::work() const {
    const std::lock_guard lock(mMutex);
    const bool waits = std::any_of(mWishes.begin(), mWishes.end(), [](const auto& wish) { return !!wish; });
    return waits ? std::optional(mWork) : std::nullopt;
}

std::string GroundPainting::takeProblem() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mProblem, "");
}

std::shared_ptr<const PaintLegend> GroundPainting::legend() const {
    const std::lock_guard lock(mMutex);
    return mLegend;
}

// --- the thread

void GroundPainting::workOff() {
    stepBehindTheWindow();
    stepBehindTheWindow();  // and behind the thread that makes frames
    loopOnThisThreadAlone();
    interruptLoopsBy(&mDrop);
    for (;;) {
        Layer layer = kLayers;
        Wish wish;
        long long number = 0;
        {
            const std::lock_guard lock(mMutex);
            mProgress.reset();
            for (const Layer one : {kTracks, kPaint})
                if (mWishes[one] && layer == kLayers) layer = one;
            if (layer == kLayers) {
                mWorks = false;
                return;
            }
            wish = *mWishes[layer];
            number = mNumbers[layer];
            mWork = {};
            mAtWork = layer;
            mDrop = false;
            mProgress = std::make_shared<Progress>([this](double fraction, const std::string& what) {
                const std::lock_guard guard(mMutex);
                mWork = {fraction, what};
            });
        }
        work(layer, number, wish, *mProgress);
    }
}

void GroundPainting::work(Layer layer, long long number, const Wish& wish, Progress& progress) {
    Painted made;
    std::string problem;
    bool done = false;
    try {
        made = painted(layer, wish, progress);
        done = true;
    } catch (const Cancelled&) {
        // by a newer wish, a person, or at the end
    } catch (const std::exception& error) {
        problem = error.what();
    }
    const std::lock_guard lock(mMutex);
    if (mNumbers[layer] != number) return;
    if (done && mWishes[layer]) show(layer, std::move(made));  // else it was cancelled at its end
    mWishes[layer].reset();
    if (!problem.empty()) mProblem = problem;
}

const SurveyGround& GroundPainting::survey(Progress& progress) {
    if (!mSurvey) mSurvey = std::make_unique<SurveyGround>(loadSurveyGround(mOptions, progress));
    return *mSurvey;
}

GroundPainting::Painted GroundPainting::painted(Layer layer, const Wish& wish, Progress& progress) {
    Painted made{wish.text, nullptr, {}};
    if (wish.seenFrom)
        made.text = paintSeenFrom(survey(progress), wish.seenFrom->place, wish.seenFrom->height);
    if (layer == kContours) {
        made.painter = contoursOf(mTerrain, mFog, contourOptions(made.text), made.legend);
    } else if (layer == kTracks && !made.text.empty()) {
        progress.report(0, "reading " + made.text);
        made.painter = trackPainter(mTerrain, mFog, made.text, made.legend);
    } else if (layer == kPaint && surveyed(made.text)) {
        made.painter = surveyPainter(mTerrain, mFog, survey(progress), made.text, made.legend, progress);
    } else if (layer == kPaint) {
        if (Legend colors = legendOfPaint(groundPaintOf(mOptions)); !colors.entries.empty())
            made.legend.legends.push_back(std::move(colors));
    }
    return made;
}

void GroundPainting::show(Layer layer, Painted painted) {
    mShown[layer] = std::move(painted);
    auto legend = std::make_shared<PaintLegend>();
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (const Painted& shown : mShown) {
        append(legend->legends, shown.legend.legends);
        append(legend->notes, shown.legend.notes);
        append(legend->places, shown.legend.places);
        append(legend->lines, shown.legend.lines);
    }
    mLegend = std::move(legend);
    ++mVersion;
}

void GroundPainting::takeUp() {
    if (mTaken == mVersion) return;
    const std::lock_guard lock(mMutex);
    mTaken = mVersion;
    std::vector<std::shared_ptr<const EyePainter>> painters;
    for (const Painted& shown : mShown)
        if (shown.painter) painters.push_back(shown.painter);
    mPaint.set(std::move(painters));
}

}  // namespace stereonav
