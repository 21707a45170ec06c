#include "app/scene/terrain/ground_painting.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/options/option_numbers.h"
#include "app/options/paint_words.h"
#include "app/scene/terrain/ground_paint.h"
#include "app/scene/terrain/ground_paint_survey.h"
#include "app/scene/terrain/ground_paint_tracks.h"
#include "engine/base/error.h"
#include "engine/base/lone_loops.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/base/thread_priority.h"
#include "terrain/scene/ground_color.h"
#include "terrain/scene/map_tones.h"
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
    std::string given = options.given.text("contours");
    if (!given.empty() || !options.ground.contours_m) return given;
    return fmt::format("{:.6g}", *options.ground.contours_m);
}

SunAngles sunOf(const TerrainLook& look) {
    return {look.sunAzimuth, look.sunElevation};
}

}  // namespace

const std::array<const char*, GroundPainting::kLayers> GroundPainting::kKeys{"paint", "contours", "tracks"};

GroundPainting::GroundPainting(const TerrainScene& terrain, const Fog& fog, const SceneOptions& options,
                               SurfacePaint& paint, std::function<void(const GroundWorn&)> wear)
    : mTerrain(terrain),
      mFog(fog),
      mOptions(options),
      mPaint(paint),
      mWear(std::move(wear)),
      mLoadedSource(terrain.report.colorSource),
      mSunTaken(sunOf(terrain.look)),
      mSunAsked(mSunTaken),
      mSun(mSunTaken),
      mLegend(std::make_shared<PaintLegend>()) {
    mWorn.paint = terrain.colorSource ? terrain.colorSource->paint : GroundPaint::None;
}

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
    double done = 0;
    constexpr double kAll = kLayers;
    for (const auto& [layer, text] :
         {std::pair(kPaint, mOptions.paint), std::pair(kContours, contours), std::pair(kTracks, tracks)}) {
        Progress part(progress, done / kAll, (done + 1) / kAll);
        Painted made = painted(layer, {text, {}, mSun}, part);
        ++done;
        const std::lock_guard lock(mMutex);
        show(layer, std::move(made));
    }
    mSurvey.reset();  // a single picture needs no other survey
    takeUp();
}

bool GroundPainting::takes(const std::string& key, const std::string& text) const {
    const Layer layer = layerOf(key);
    if (layer != kPaint) return layer != kLayers;
    if (text.empty() || surveyed(text)) return true;
    return mTerrain.colorSource && groundPaintOf(text) != GroundPaint::None;
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
    const bool quick = layer == kContours || (text.empty() && (layer != kPaint || loadedPlain()));
    if (!quick) return wish(layer, {text, {}, {}});
    Progress quiet;
    Painted made = painted(layer, {text, {}, {}}, quiet);  // contours are made at once
    const std::lock_guard lock(mMutex);
    ++mNumbers[layer];
    mWishes[layer].reset();
    if (mAtWork == layer) drop();
    show(layer, std::move(made));
}

void GroundPainting::askSeenFrom(const glm::dvec2& place, double height) {
    wish(kPaint, {"", SeenFrom{place, height}, {}});
}

void GroundPainting::wish(Layer layer, Wish wish) {
    {
        const std::lock_guard lock(mMutex);
        ++mNumbers[layer];
        mWishes[layer] = std::move(wish);
        if (mAtWork == layer) drop();
        if (std::exchange(mWorks, true)) return;
    }
    const std::lock_guard begin(mBegin);
    if (mThread.joinable()) mThread.join();  // the thread has nothing left to do
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
    stepBehindTheWindow();  // a second time: the thread that makes frames goes first, too
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
            wish.sun = mSun;
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
        // cancelled by a newer wish, by the user, or at the end
    } catch (const std::exception& error) {
        problem = error.what();
    }
    const std::lock_guard lock(mMutex);
    if (mNumbers[layer] != number) return;
    if (!mWishes[layer]) return;  // cancelled just before it was complete
    if (done) show(layer, std::move(made));
    mWishes[layer].reset();
    if (!problem.empty()) mProblem = problem;
}

const SurveyGround& GroundPainting::survey(Progress& progress) {
    if (mSurvey) return *mSurvey;
    SceneOptions options = mOptions;
    if (mTerrain.tiled || mTerrain.standIn) options.tiles = TilesChoice::On;  // like the scene itself
    mSurvey = std::make_unique<SurveyGround>(readSurveyGround(options, progress));
    return *mSurvey;
}

GroundPainting::Painted GroundPainting::painted(Layer layer, const Wish& wish, Progress& progress) {
    constexpr const char* kPainting = "painting the ground";
    progress.report(0, kPainting);
    Progress reading(progress, 0, 0.4), looking(progress, 0.4, 0.7), colouring(progress, 0.7, 1);
    Painted made{wish.text, nullptr, {}, {}};
    if (wish.seenFrom)
        made.text = paintSeenFrom(survey(reading), wish.seenFrom->place, wish.seenFrom->height);
    if (layer == kContours) {
        made.painter = contoursOf(mTerrain, mFog, contourOptions(made.text), made.legend);
    } else if (layer == kTracks && !made.text.empty()) {
        progress.report(0, "reading " + made.text);
        made.painter = trackPainter(mTerrain, mFog, made.text, made.legend);
    } else if (layer == kPaint) {
        const GroundPaint paint = groundPaintOf(made.text);
        if (surveyed(made.text))
            made.painter = surveyPainter(mTerrain, mFog, survey(reading), made.text, made.legend, looking);
        if (Legend colors = legendOf(paint); !colors.entries.empty())
            made.legend.legends.push_back(std::move(colors));
        made.ground = groundAs(paint, wish.sun, colouring);
    }
    progress.report(1, kPainting);
    return made;
}

Legend GroundPainting::legendOf(GroundPaint paint) const {
    const auto palette = paletteOf(paint);
    if (!palette) return legendOfPaint(paint);
    const Heightfield& ground = mTerrain.ground;
    return legendOfPalette(*palette, ground.minHeight() / mTerrain.verticalScale,
                           ground.maxHeight() / mTerrain.verticalScale);
}

bool GroundPainting::loadedPlain() const {
    return !mTerrain.colorSource || mTerrain.colorSource->paint == GroundPaint::None;
}

GroundWorn GroundPainting::groundAs(GroundPaint paint, const SunAngles& sun, Progress& progress) const {
    GroundWorn worn{paint, nullptr, mLoadedSource, sun};
    if (!mTerrain.colorSource) return worn;  // colours from a picture
    const GroundColorSource& source = *mTerrain.colorSource;
    const bool asLoaded = !turnsWithSun(paint, source) || sun == sunOf(source.look);
    if (paint == source.paint && asLoaded) return worn;
    const Heightfield& ground = mTerrain.ground;
    checkMemory("colours of the ground", bytesOfTint(double(ground.width()) * ground.height()), "");
    GroundColor color = groundColorsAs(paint, ground, source, sun, progress);
    if (source.alone) leaveOutLit(color.source);
    worn.texture = std::make_shared<const ColorTexture>(std::move(color.texture));
    worn.source = std::move(color.source);
    return worn;
}

std::string GroundPainting::colorSource() const {
    const std::lock_guard lock(mMutex);
    return mShown[kPaint].ground.source;
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
    const SunAngles sun = sunOf(mTerrain.look);
    if (mTaken == mVersion && mSunTaken == sun) return;
    mSunTaken = sun;
    GroundWorn ground;
    std::string again;  // name of the paint to make again after the sun has turned
    {
        const std::lock_guard lock(mMutex);
        mTaken = mVersion;
        mSun = sun;
        std::vector<std::shared_ptr<const EyePainter>> painters;
        for (const Painted& shown : mShown)
            if (shown.painter) painters.push_back(shown.painter);
        mPaint.set(std::move(painters));
        ground = mShown[kPaint].ground;
        const bool turns = mTerrain.colorSource && turnsWithSun(ground.paint, *mTerrain.colorSource);
        if (turns && !mWishes[kPaint] && ground.sun != sun && mSunAsked != sun) again = mShown[kPaint].text;
    }
    if (ground.texture != mWorn.texture || ground.paint != mWorn.paint) mWear(ground);
    mWorn = std::move(ground);
    if (again.empty()) return;
    mSunAsked = sun;
    wish(kPaint, {again, {}, {}});
}

}  // namespace stereonav
