#include "app/scene/terrain/shown_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/scene/terrain/daylight.h"
#include "app/scene/terrain/finer_sky.h"
#include "app/scene/terrain/ground_paint.h"
#include "app/scene/terrain/ground_painting.h"
#include "app/scene/terrain/terrain_facts.h"
#include "engine/nav/navigator.h"
#include "engine/text/length_text.h"
#include "terrain/read/height_limits.h"
#include "terrain/scene/ground_map.h"
#include "terrain/scene/ground_place.h"
#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_illumination.h"
#include "terrain/scene/terrain_loader.h"

namespace stereonav {
namespace {

constexpr double kCrossingSeconds = 45.0;  // time to cross the terrain at normal speed

FlightSetting flightSettingOf(const TerrainScene& terrain) {
    const glm::dvec2 held = terrain.ground.spacing(),
                     spacing = terrain.tiled ? terrain.tiled->levels->spacing(0) : held;
    const double extent =
        std::max(held.x * (terrain.ground.width() - 1), held.y * (terrain.ground.height() - 1));
    FlightSetting setting;
    setting.clearance = terrain.clearance;
    setting.followHeight = std::max(4 * terrain.clearance, extent / 150);
    setting.speed = extent / kCrossingSeconds;
    setting.groundStep = 0.5 * std::min(spacing.x, spacing.y);
    return setting;
}

// Returns what of the options for ground this one takes.
SceneLimits limitsOf(const TerrainScene& terrain) {
    SceneLimits limits;
    if (terrain.colorSource) limits.refused.emplace_back("shade-image", "");  // there is no picture to light
    if (terrain.report.driver == "built-in") limits.refused.emplace_back("open-holes", "");
    if (terrain.landmarks) limits.refused.emplace_back("curvature", "");  // they stand on flat ground
    const double highest =
        std::max(std::abs(terrain.ground.minHeight()), std::abs(terrain.ground.maxHeight())) /
        terrain.verticalScale;
    constexpr double kLeast = 1e-6, kMost = 1e6;  // range of --vertical-scale
    constexpr double kRounded = 1 - 1e-5;         // the window rounds to six digits
    if (highest > 0)
        limits.ranges["vertical-scale"] = within(kLeast, std::min(kMost, kRounded * kMostHeight_m / highest));
    return limits;
}

}  // namespace

std::unique_ptr<Flight> flightOver(const TerrainScene& terrain) {
    const auto ground = [&terrain](const glm::dvec2& place) { return terrain.heightAt(place); };
    return std::make_unique<Navigator>(ground, terrain.startPose, flightSettingOf(terrain));
}

void setViews(const TerrainScene& terrain, Scene& scene) {
    scene.lens = terrain.lens;
    scene.stereo = terrain.stereo;
    scene.eyesGiven = terrain.eyesGiven;
    scene.startPose = terrain.startPose;
    scene.path = terrain.path;
}

TerrainSurvey::TerrainSurvey(const TerrainScene& terrain) : mTerrain(terrain), mLine(terrain) {
    const Heightfield& ground = terrain.ground;
    const glm::dvec2 low = ground.originWorld(),
                     high = ground.worldFromGrid({ground.width() - 1, ground.height() - 1});
    mBox = {{low, ground.minHeight()}, {high, ground.maxHeight()}};
}

MapPicture TerrainSurvey::makeMap(int most, Progress& progress) const {
    GroundMap map = mapOfGround(mTerrain, most, progress);
    return {std::move(map.picture), map.northWest, map.metresPerPixel};
}

std::optional<PlaceOnEarth> TerrainSurvey::placeAt(const glm::dvec3& world) const {
    const std::optional<EarthPlace> place = mTerrain.earth->placeAt(glm::dvec2(world));
    if (!place) return std::nullopt;
    return PlaceOnEarth{place->latitude, place->longitude};
}

std::optional<glm::dvec2> TerrainSurvey::worldAt(const PlaceOnEarth& place) const {
    return mTerrain.earth->worldAt({place.latitude, place.longitude});
}

// Returns the azimuth of true north in the world, from a step to the north and one to the south.
double TerrainSurvey::northAt(const glm::dvec3& world) const {
    constexpr double kStep = 1e-5;  // radians: 64 m
    const std::optional<PlaceOnEarth> place = placeAt(world);
    if (!place || std::abs(place->latitude) + kStep > std::numbers::pi / 2) return 0;
    const auto north = worldAt({place->latitude + kStep, place->longitude}),
               south = worldAt({place->latitude - kStep, place->longitude});
    if (!north || !south) return 0;
    const glm::dvec2 way = *north - *south;
    return std::atan2(way.x, way.y);
}

Facts TerrainSurvey::readPlace(const glm::dvec3& world) const {
    constexpr double kDegrees = 180 / std::numbers::pi;
    const std::optional<GroundPlace> place = groundPlaceAt(mTerrain, glm::dvec2(world));
    if (!place) return {};
    FactList list;
    if (place->earth) {
        const double north = place->earth->latitude * kDegrees, east = place->earth->longitude * kDegrees;
        list.both("latitude_longitude", FactNumbers{north, east}, "latitude and longitude",
                  fmt::format("{:.5f} {} {:.5f} {}", std::abs(north), north < 0 ? 'S' : 'N', std::abs(east),
                              east < 0 ? 'W' : 'E'));
    }
    if (place->reference)
        list.both("reference", FactNumbers{place->reference->x, place->reference->y},
                  "east and north, " + mTerrain.report.sourceCrs,
                  fixedText(place->reference->x, 1) + " " + fixedText(place->reference->y, 1));
    list.both("height_m", place->height, "height", fixedText(place->height, 1) + " m", "m");
    list.both("slope_degrees", place->slope * kDegrees, "slope",
              fmt::format("slope {:.1f}\u00b0", place->slope * kDegrees));
    if (place->aspect)
        list.both("aspect_degrees", *place->aspect * kDegrees,
                  "where it falls, clockwise from the grid's north",
                  fmt::format("to {:.0f}\u00b0", *place->aspect * kDegrees));
    return std::move(list.facts());
}

// Turns the sun over baked light.
class ShownTerrain::Sun final : public TurningLight {
public:
    explicit Sun(GroundColors& colors) : mColors(colors) {}

    SunPlace place() const override { return mColors.sun(); }
    void turnTo(const SunPlace& to) override {
        if (to != place()) mColors.turnSun(to);
    }

private:
    GroundColors& mColors;
};

// Turns the sun over ground in its own colours whose light is computed meanwhile. All functions but changes()
// are called between frames.
class ShownTerrain::Daylight final : public TurningLight, public SeenLight {
public:
    Daylight(TerrainScene& terrain, TerrainRenderer& renderer, GroundColors& colors)
        : mTerrain(terrain), mRenderer(renderer), mColors(colors), mBaker(terrain, renderer.target()) {}

    SunPlace place() const override { return mColors.sun(); }
    void turnTo(const SunPlace& to) override {
        std::unique_ptr<LitGround> better = mBaker.take();
        const bool turned = to != place(), fresh = better != nullptr;
        if (fresh) std::swap(better, mShown);  // the earlier light is freed when it is no longer shown
        if (turned && mShown && !mColors.painted())
            moveSun(mTerrain, to.azimuth, to.elevation);
        else if (turned)
            mColors.turnSun(to);  // plain sunlight until better light is there
        show(fresh);
    }
    // Shows the light again after the ground's colours have changed.
    void colorsChanged() { show(true); }

    void seen(const EyeView&, const EyeImage&) override {
        if (!mColors.painted()) mBaker.begin(mColors.texture());
    }
    std::uint64_t changes() const override { return mBaker.count(); }

private:
    // fresh: whether mShown is not on display yet.
    void show(bool fresh) {
        if (!mShown || mColors.painted()) return;
        const SunPlace sun = place();
        const bool stale = mShown->sunAzimuth != sun.azimuth || mShown->sunElevation != sun.elevation;
        if (stale) mShown->lightAgain(mTerrain.look);
        if (!fresh && !stale) return;
        mRenderer.showColors(mShown->color, mShown->light.get());
        mTerrain.report.lightSource = mShown->source();
    }

    TerrainScene& mTerrain;
    TerrainRenderer& mRenderer;
    GroundColors& mColors;
    std::unique_ptr<LitGround> mShown;
    TerrainDaylight mBaker;
};

// Turns the sun over ground whose light was worked out quickly, and takes openness at more samples as it
// comes. All functions but changes() are called between frames.
class ShownTerrain::BetterSky final : public TurningLight, public SeenLight {
public:
    BetterSky(TerrainScene& terrain, GroundColors& colors)
        : mTerrain(terrain), mColors(colors), mFiner(terrain.ground) {}

    SunPlace place() const override { return mColors.sun(); }
    void turnTo(const SunPlace& to) override {
        std::optional<FinerSky::Openness> finer = mFiner.take();
        if (finer) {
            mTerrain.illumination->takeOpenness(std::move(finer->samples));
            mTerrain.report.lightSource =
                fmt::format("worked out: the sun's shadow at {}x{} samples, openness at {}x{}",
                            mTerrain.illumination->light().grid.width,
                            mTerrain.illumination->light().grid.height, finer->width, finer->height);
        }
        if (finer || to != place()) mColors.turnSun(to);
    }

    void seen(const EyeView&, const EyeImage&) override { mFiner.begin(); }
    std::uint64_t changes() const override { return mFiner.count(); }

private:
    TerrainScene& mTerrain;
    GroundColors& mColors;
    FinerSky mFiner;
};

// Redraws pictures that did not wait for tiles when these have arrived.
class ShownTerrain::LateTiles final : public SeenLight, public LateDetail {
public:
    explicit LateTiles(TerrainRenderer& renderer) : mRenderer(renderer) {}
    void seen(const EyeView&, const EyeImage&) override {}
    std::uint64_t changes() const override { return mRenderer.arrivals(); }
    bool late() const override { return mRenderer.ringDetail().late; }
    void waitForAll() override { mRenderer.ringsMayBeLate(false); }

private:
    TerrainRenderer& mRenderer;
};

class ShownTerrain::CoarseGround final : public StandIn {
public:
    explicit CoarseGround(const StandInGround& ground) : mGround(ground) {}
    const std::string& name() const override { return mGround.tiles; }
    std::string what() const override { return "making tiles; until then the ground is coarse"; }
    void prepare(Progress& progress) const override { mGround.makeTiles(progress); }

private:
    const StandInGround& mGround;
};

ShownTerrain::ShownTerrain(TerrainScene terrain, SimdTarget target, bool lightsItself)
    : mTerrain(std::move(terrain)),
      mSurvey(mTerrain),
      mRenderer(mTerrain, target),
      mColors(mTerrain, mRenderer),
      mFrames(mRenderer) {
    setViews(mTerrain, *this);
    simd = mRenderer.target();
    mRays = {&mRenderer};
    offer(mRays);
    offer<const TerrainScene>(mTerrain);
    offer<const TerrainRenderer>(mRenderer);
    mLimits = limitsOf(mTerrain);
    offer(std::as_const(mLimits));
    mSurvey.offerAll([this](auto& capability) { offer(capability); });
    if (lightsItself && mTerrain.tint) {
        mDaylight = std::make_unique<Daylight>(mTerrain, mRenderer, mColors);
        offer<TurningLight>(*mDaylight);
        offer<SeenLight>(*mDaylight);
    }
    if (mTerrain.ringsMayBeLate) {
        mTiles = std::make_unique<LateTiles>(mRenderer);
        offer<SeenLight>(*mTiles);
        offer<LateDetail>(*mTiles);
    }
    if (mTerrain.standIn) {
        mCoarse = std::make_unique<CoarseGround>(*mTerrain.standIn);
        offer<const StandIn>(*mCoarse);
    }
    if (!mTerrain.illumination) return;
    if (lightsItself && mTerrain.illumination->castsShadows() && !mTiles) {
        auto better = std::make_unique<BetterSky>(mTerrain, mColors);
        offer<TurningLight>(*better);
        offer<SeenLight>(*better);
        mSun = std::move(better);
        return;
    }
    mSun = std::make_unique<Sun>(mColors);
    offer<TurningLight>(*mSun);
}

ShownTerrain::~ShownTerrain() = default;

void ShownTerrain::paintGround(const SceneOptions& options, Progress& progress) {
    const auto wear = [this](const GroundWorn& worn) {
        mColors.wear(worn.texture, worn.paint != GroundPaint::None,
                     worn.texture ? partColorsOf(mTerrain, worn.paint, worn.sun) : partColorsOf(mTerrain));
        if (mDaylight) mDaylight->colorsChanged();
    };
    mPainting = std::make_unique<GroundPainting>(mTerrain, mRenderer.fog(), options, mPaint, wear);
    mPainting->paintAll(progress);
    mLegend = mPainting->legend();
    offer(mPaint);
    offer<LivePaint>(*mPainting);
    if (!mLegend->legends.empty()) offer<const PaintLegend>(*mLegend);
}

Facts ShownTerrain::describe() const {
    Facts facts = factsOfTerrain(*this);
    if (mPainting) {
        const std::string colors = mPainting->colorSource();
        for (Fact& fact : facts)
            if (fact.key == "color") fact = factForAll("color", colors, "colour", colors);
        addLegend(*mPainting->legend(), facts);
    }
    return {factForJson("terrain", std::move(facts))};
}

std::string ShownTerrain::whyLightStays() const {
    return mSun || mDaylight ? "" : "the sun is part of this ground's colours: --light gives one that moves";
}

}  // namespace stereonav
