// The report's chart of baked light on terrain: by rays, order, azimuths, bounces and spacing of the baked
// samples, against path tracing at places between them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/report/light.h"
#include "engine/base/parallel.h"
#include "engine/light/skies/sky_map.h"
#include "terrain/built_in/built_in_terrain.h"
#include "terrain/light/terrain_path_light.h"
#include "terrain/light/terrain_relight.h"
#include "terrain/read/scene_file.h"

namespace stereonav {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSunAzimuth = 120, kSunElevation = 25;  // degrees: gives shadows, and bounced light in them

glm::vec3 skyAbove(const glm::dvec3& direction) {
    return gradientSky(glm::vec3(direction));
}

// A small generated terrain, under a sun and a sky.
struct LitGroundSample {
    Heightfield ground;
    SunAndSky light;
    float scale = 1;  // factor on the sky's radiance
};

LitGroundSample groundSample(int side) {
    Progress quiet;
    const BuiltInTerrain built = generateBuiltInTerrain(1, side, quiet, std::nullopt);
    LitGroundSample sample;
    sample.ground =
        Heightfield(built.size, built.size, glm::dvec2(built.spacing), built.heights, "generated");
    TerrainLook look;
    look.sunAzimuth = kSunAzimuth * kDegree;
    look.sunElevation = kSunElevation * kDegree;
    const SkyRadiance sky = skyRadiance(skyAbove);
    sample.light = sunAndSky(look, sky);
    sample.scale = sample.light.sky.level.y / sky.level.y;
    return sample;
}

// Returns a place on the grid; places are evenly spread (Roberts 2018).
glm::dvec2 tracedPlace(const Heightfield& ground, int n) {
    const glm::dvec2 last(ground.width() - 1, ground.height() - 1);
    return glm::dvec2(std::fmod(0.5 + n * 0.75487766624669276, 1.0),
                      std::fmod(0.5 + n * 0.56984029099805327, 1.0)) *
           last;
}

// Places of the ground, from `first` on.
struct GroundTruthOrder {
    std::uint64_t seed;
    int side, first, count, paths;
};
struct TracedPlace {
    double light = 0, variance = 0;
};

// Path-traced light at places all over the ground.
class GroundSubject {
public:
    explicit GroundSubject(ReportRun& run) : mRun(run) {
        run.tell("terrain's light");
        LitGroundSample sample = groundSample(side());
        mGround = std::move(sample.ground);
        mLight = sample.light;
        trace();
    }

    WayPoint pointOf(const std::string& name, const std::string& detail, const TerrainLightSettings& settings,
                     bool isDefault) {
        std::vector<double> ms;
        TerrainLight light;
        for (int n = 0; n < mRun.pick(2, 5); ++n) {
            mRun.tell("terrain's light, " + name);
            Progress quiet;
            const Stopwatch watch;
            light = bakeTerrainLight(mGround, settings, quiet);
            ms.push_back(watch.elapsed_ms());
        }
        WayPoint point;
        point.way = {name,
                     scaled(spreadOf(ms), 1000 / static_cast<double>(mGround.width() * mGround.height())), 0,
                     isDefault};
        point.detail = detail;
        setErrors(light, point);
        point.others = {{"bytes a sample",
                         static_cast<double>(light.byteCount()) / static_cast<double>(light.grid.count())}};
        return point;
    }

    std::string size() const { return fmt::format("{}x{}", mGround.width(), mGround.height()); }
    std::size_t places() const { return mPlaces.size(); }
    double truthNoise_percent() const { return 100 * std::sqrt(mVariance) / mMean; }

private:
    int side() const { return mRun.pick(81, 161); }

    void trace() {
        constexpr int kPlaces = 25;  // places of a piece
        std::vector<UntimedPiece> pieces;
        const int count = mRun.pick(100, 400);
        for (int n = 0; n < count; n += kPlaces)
            pieces.push_back(pieceOf(Untimed::GroundTruth,
                                     GroundTruthOrder{mRun.options().seed, side(), n,
                                                      std::min(kPlaces, count - n), mRun.pick(512, 4096)}));
        for (const PeerBytes& piece : mRun.untimed().all(pieces))
            for (const TracedPlace& place : ByteReader(piece).getArray<TracedPlace>()) {
                mPlaces.push_back(tracedPlace(mGround, static_cast<int>(mPlaces.size())));
                mTruth.push_back(place.light);
                mMean += place.light / count;
                mVariance += place.variance / count;
            }
    }

    double brightnessAt(const TerrainLight& light, const GroundBrightness& brightness,
                        const glm::dvec2& place) const {
        const LightGrid::Place x = light.grid.placeX(place.x), y = light.grid.placeY(place.y);
        double sum = 0;
        for (int c = 0; c < 4; ++c)
            sum += (c & 1 ? x.next : 1 - x.next) * (c & 2 ? y.next : 1 - y.next) *
                   luminance(glm::dvec3(brightness.at(x.index + (c & 1), y.index + (c >> 1))));
        return sum;
    }

    void setErrors(const TerrainLight& light, WayPoint& point) const {
        GroundBrightness brightness;
        TerrainRelight(mGround, light).relight(mLight, brightness);
        double squares = 0, worst = 0;
        for (std::size_t n = 0; n < mPlaces.size(); ++n) {
            const double off = std::abs(brightnessAt(light, brightness, mPlaces[n]) - mTruth[n]);
            squares += off * off / static_cast<double>(mPlaces.size());
            worst = std::max(worst, off);
        }
        point.way.error = 100 * std::sqrt(std::max(0.0, squares - mVariance)) / mMean;
        point.worstError = 100 * worst / mMean;
    }

    ReportRun& mRun;
    Heightfield mGround;
    SunAndSky mLight;
    std::vector<glm::dvec2> mPlaces;  // grid coordinates
    std::vector<double> mTruth;
    double mMean = 0, mVariance = 0;
};

}  // namespace

PeerBytes makeGroundTruth(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<GroundTruthOrder>();
    run.tell("terrain's light, the truth");
    const auto sample = run.untimed().kept<LitGroundSample>(fmt::format("ground {}", asked.side),
                                                            [&] { return groundSample(asked.side); });
    const GroundRays rays(sample->ground);
    const TerrainLightSettings usual;
    std::vector<TracedPlace> places(static_cast<std::size_t>(asked.count));
    parallelFor(asked.count, [&](int k) {
        const int n = asked.first + k;
        PathLightSetting setting;
        setting.albedo = usual.albedo;
        setting.bounces = usual.bounces;
        setting.paths = asked.paths;
        setting.seed = asked.seed + 7919 * static_cast<std::uint64_t>(n);
        const PathLight path = tracePathLight(
            rays, sample->ground.worldFromGrid(tracedPlace(sample->ground, n)), sample->light,
            [&](const glm::dvec3& d) { return sample->scale * skyAbove(d); }, setting);
        places[static_cast<std::size_t>(k)] = {luminance(glm::dvec3(path.mean)), path.variance};
    });
    return ByteWriter().putArray(std::span<const TracedPlace>(places)).take();
}

WayChart terrainLightChart(ReportRun& run) {
    GroundSubject subject(run);
    const TerrainLightSettings usual;
    WayChart chart;
    chart.id = "light/terrain";
    chart.title = "Baked light of terrain";
    chart.setting = fmt::format("{} samples, {} threads, seed {}, truth of {} paths", subject.size(),
                                threadCount(), run.options().seed, run.pick(512, 4096));
    chart.text = fmt::format(
        "The generated terrain in small, the sun {:g} degrees high; light at {} places between samples "
        "against path tracing, whose own noise, {} %, is taken out. Most of the error lies at the edges of "
        "shadows. Time of the bake for 1000 samples of the ground.",
        kSunElevation, subject.places(), numberText(subject.truthNoise_percent()));
    chart.why = "The default's order is for skies with more shape than this one.";
    chart.timeLabel = "ms for 1000 samples";
    chart.errorLabel = "RMS error, % of the light";
    chart.errorUnit = "%";
    chart.points.push_back(
        subject.pointOf("as it is",
                        fmt::format("order {}, {} rays, {} azimuths, {} bounces", usual.order, usual.rays,
                                    usual.azimuths, usual.bounces),
                        usual, true));
    const auto add = [&](auto TerrainLightSettings::*what, const char* name, auto value) {
        TerrainLightSettings changed = usual;
        changed.*what = value;
        chart.points.push_back(
            subject.pointOf(fmt::format("{} {}", name, value), "the rest as it is", changed, false));
    };
    for (const int order : run.brief() ? std::vector<int>{1} : std::vector<int>{1, 2, 3, 6})
        add(&TerrainLightSettings::order, "order", order);
    for (const int rays : run.brief() ? std::vector<int>{128} : std::vector<int>{16, 64, 256})
        add(&TerrainLightSettings::rays, "rays", rays);
    for (const int azimuths : run.brief() ? std::vector<int>{} : std::vector<int>{16, 64})
        add(&TerrainLightSettings::azimuths, "azimuths", azimuths);
    for (const int bounces : run.brief() ? std::vector<int>{0} : std::vector<int>{0, 1})
        add(&TerrainLightSettings::bounces, "bounces", bounces);
    for (const int stride : run.brief() ? std::vector<int>{4} : std::vector<int>{2, 4})
        add(&TerrainLightSettings::stride, "stride", stride);
    TerrainLightSettings open = usual;
    open.kind = TerrainLightKind::Openness;
    chart.points.push_back(subject.pointOf("openness alone", "without horizons and bounces", open, false));
    return chart;
}

}  // namespace stereonav
