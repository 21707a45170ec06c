// What a terrain's light costs to bake, to relight and to show, and how far it is from path tracing.
// With --marks: one JSON object; figures of one run, to be compared with each other.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/camera/stereo_rig.h"
#include "engine/math/luminance.h"
#include "terrain/built_in/built_in_terrain.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/light/terrain_path_light.h"
#include "terrain/scene/terrain_illumination.h"

namespace stereonav::bench {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kDegree = std::numbers::pi / 180;

const BuiltInTerrain& built() {
    static const BuiltInTerrain terrain = [] {
        Progress quiet;
        return generateBuiltInTerrain(1, 161, quiet, std::nullopt);
    }();
    return terrain;
}

const Heightfield& ground() {
    static const Heightfield field(built().size, built().size, glm::dvec2(built().spacing), built().heights,
                                   "built-in");
    return field;
}

double fastest_ms(int rounds, const std::function<void()>& work) {
    double best = std::numeric_limits<double>::infinity();
    for (int k = 0; k < rounds; ++k) {
        const Stopwatch watch;
        work();
        best = std::min(best, watch.elapsed_ms());
    }
    return best;
}

TerrainLight bake(const TerrainLightSettings& settings) {
    Progress quiet;
    return bakeTerrainLight(ground(), settings, quiet);
}

// The first coefficients are the same at every order.
TerrainLight truncated(const TerrainLight& light, int order) {
    TerrainLight less = light;
    less.settings.order = order;
    less.full.resize(light.grid.count() * lightHarmonics(order));
    less.bounced.resize(less.full.size());
    return less;
}

// Path-traced light at places all over the ground, between samples, under one sun.
struct Truth {
    SunAndSky light;
    std::vector<glm::dvec2> places;  // grid
    std::vector<double> values;
    double mean = 0, noise = 0;  // noise: mean variance of the values
};

Truth truthFor(const GroundRays& rays, double azimuth, double elevation, int bounces) {
    Truth truth;
    TerrainLook look;
    look.sunAzimuth = azimuth * kDegree;
    look.sunElevation = elevation * kDegree;
    const auto gradient = [](const glm::dvec3& d) { return gradientSky(glm::vec3(d)); };
    const SkyRadiance sky = skyRadiance(gradient);
    truth.light = sunAndSky(look, sky);
    const float scale = truth.light.sky.level.y / sky.level.y;
    constexpr int kPlaces = 400;
    const glm::dvec2 size(ground().width() - 1, ground().height() - 1);
    for (int k = 0; k < kPlaces; ++k) {
        const double x = std::fmod(0.5 + k * 0.75487766624669276, 1.0),
                     y = std::fmod(0.5 + k * 0.56984029099805327, 1.0);
        truth.places.push_back(glm::dvec2(x, y) * size);
    }
    truth.values.resize(kPlaces);
    std::vector<double> variances(kPlaces);
    parallelFor(kPlaces, [&](int k) {
        const PathLightSetting setting{0.3, bounces, 4096, static_cast<std::uint64_t>(k) * 7919 + 1};
        const PathLight path = tracePathLight(
            rays, ground().worldFromGrid(truth.places[k]), truth.light,
            [&](const glm::dvec3& d) { return scale * gradient(d); }, setting);
        truth.values[k] = luminance(path.mean);
        variances[k] = path.variance;
    });
    for (int k = 0; k < kPlaces; ++k) {
        truth.mean += truth.values[k] / kPlaces;
        truth.noise += variances[k] / kPlaces;
    }
    return truth;
}

double brightnessAt(const TerrainLight& light, const GroundBrightness& brightness, const glm::dvec2& place) {
    const LightGrid::Place x = light.grid.placeX(place.x), y = light.grid.placeY(place.y);
    double sum = 0;
    for (int c = 0; c < 4; ++c)
        sum += (c & 1 ? x.next : 1 - x.next) * (c & 2 ? y.next : 1 - y.next) *
               luminance(glm::dvec3(brightness.at(x.index + (c & 1), y.index + (c >> 1))));
    return sum;
}

struct Difference {
    double rms, bias;  // shares of the mean
};

Difference differenceOf(const TerrainLight& light, const Truth& truth) {
    GroundBrightness brightness;
    TerrainRelight(ground(), light).relight(truth.light, brightness);
    double square = 0, bias = 0;
    const double count = static_cast<double>(truth.places.size());
    for (std::size_t k = 0; k < truth.places.size(); ++k) {
        const double d = brightnessAt(light, brightness, truth.places[k]) - truth.values[k];
        square += d * d / count;
        bias += d / count;
    }
    return {std::sqrt(std::max(0.0, square - truth.noise)) / truth.mean, bias / truth.mean};
}

struct Sun {
    double azimuth, elevation;
};
constexpr Sun kSuns[] = {{315, 45}, {120, 25}, {250, 10}};

Json errors() {
    const GroundRays rays(ground());
    TerrainLightSettings settings;
    settings.order = 6;
    settings.rays = 256;
    const TerrainLight best = bake(settings);
    Json json;
    for (const Sun& sun : kSuns) {
        const Truth truth = truthFor(rays, sun.azimuth, sun.elevation, settings.bounces);
        Json one;
        one["truth_noise"] = std::sqrt(truth.noise) / truth.mean;
        for (int order = 1; order <= 6; ++order) {
            const Difference d = differenceOf(truncated(best, order), truth);
            one["rms_order_" + std::to_string(order)] = d.rms;
            if (order == 4) one["bias_order_4"] = d.bias;
        }
        for (const int count : {16, 32}) {
            TerrainLightSettings fewer = settings;
            fewer.order = 4;
            fewer.rays = count;
            one["rms_order_4_rays_" + std::to_string(count)] = differenceOf(bake(fewer), truth).rms;
        }
        for (const int azimuths : {16, 64}) {
            TerrainLightSettings other = settings;
            other.order = 4;
            other.azimuths = azimuths;
            one["rms_order_4_azimuths_" + std::to_string(azimuths)] = differenceOf(bake(other), truth).rms;
        }
        TerrainLightSettings dark = settings;
        dark.bounces = 0;
        dark.order = 4;
        one["rms_without_bounces"] = differenceOf(bake(dark), truth).rms;
        TerrainLightSettings open = settings;
        open.kind = TerrainLightKind::Openness;
        one["rms_openness"] = differenceOf(bake(open), truth).rms;
        json[std::to_string(static_cast<int>(sun.elevation)) + "_degrees"] = one;
    }
    return json;
}

// Rays from all over the ground into its cosine-weighted sky: what a baker by plain path tracing casts.
double raysPerSecond() {
    const GroundRays rays(ground());
    constexpr int kPackets = 20000;
    const auto packetOf = [&](int n) {
        RayPacket p{};
        for (int k = 0; k < RayPacket::kSize; ++k) {
            const int m = n * RayPacket::kSize + k;
            const auto share = [&](double step) { return std::fmod(m * step, 1.0); };
            const glm::dvec2 world = ground().worldFromGrid(
                glm::dvec2(std::fmod(n * 0.7548776662, 1.0), std::fmod(n * 0.5698402910, 1.0)) *
                double(ground().width() - 1));
            const double z = std::sqrt(1 - share(0.8191725134)), phi = 6.283185307 * share(0.6710436067);
            p.originX[k] = static_cast<float>(world.x);
            p.originY[k] = static_cast<float>(world.y);
            p.originZ[k] = static_cast<float>(rays.heightAt(world) - rays.centreHeight() + rays.lift());
            p.directionX[k] = static_cast<float>(std::sqrt(1 - z * z) * std::cos(phi));
            p.directionY[k] = static_cast<float>(std::sqrt(1 - z * z) * std::sin(phi));
            p.directionZ[k] = static_cast<float>(z);
        }
        return p;
    };
    std::vector<RayPacket> packets;
    for (int n = 0; n < kPackets; ++n) packets.push_back(packetOf(n));
    const double ms = fastest_ms(3, [&] {
        parallelFor(kPackets / 100, [&](int first) {
            for (int n = first * 100; n < first * 100 + 100; ++n) rays.intersect(packets[n], 0xffff);
        });
    });
    return kPackets * RayPacket::kSize / ms * 1000;
}

Json bakeRates() {
    TerrainLightSettings settings;
    Json json;
    const double samples = static_cast<double>(ground().width()) * ground().height();
    TerrainLightSettings direct = settings;
    direct.bounces = 0;
    const double direct_ms = fastest_ms(2, [&] { bake(direct); }),
                 all_ms = fastest_ms(2, [&] { bake(settings); });
    json["bake_samples_per_s"] = samples / all_ms * 1000;
    json["bake_direct_samples_per_s"] = samples / direct_ms * 1000;
    json["gather_rays_per_s"] = samples * settings.rays * settings.bounces / (all_ms - direct_ms) * 1000;
    json["embree_rays_per_s"] = raysPerSecond();
    return json;
}

// Big Tujunga's 1197 x 643 samples and a texture of two texels a sample; the content does not matter.
Json relightTimes() {
    const Heightfield plain(1197, 643, {30, 30}, std::vector<float>(std::size_t{1197} * 643, 0.0f), "plain");
    TerrainLight light;
    light.grid = LightGrid(plain, 1);
    light.openness.resize(light.grid.count(), 200);
    light.horizon.resize(light.grid.count() * light.settings.azimuths, 20);
    light.full.resize(light.grid.count() * lightHarmonics(light.settings.order), 3000);
    light.bounced.resize(light.full.size(), 300);
    Json json;
    json["relight_bytes_per_sample"] =
        static_cast<double>(light.byteCount()) / static_cast<double>(light.grid.count());
    ColorTexture albedo(Plane<PackedColor>(2394, 1286), glm::dvec2(-0.5), glm::dvec2(0.5)), lit = albedo;
    const TerrainRelight relight(plain, std::move(light));
    const SunAndSky now = sunAndSky({}, skyRadiance([](const glm::dvec3&) { return glm::vec3(0.5f); }));
    GroundBrightness brightness;
    json["relight_ms"] = fastest_ms(15, [&] { relight.relight(now, brightness); });
    json["relight_texture_ms"] = fastest_ms(15, [&] {
        relight.lightTexture(albedo, brightness, {1, 1}, lit);
    });
    return json;
}

// One picture with and without baked light, in turn.
Json frameTimes() {
    const auto sceneOf = [&](bool baked) {
        TerrainScene scene;
        scene.ground = ground();
        const glm::dvec2 texels(built().color.width(), built().color.height());
        scene.color = ColorTexture(built().color, {0.0, 0.0}, glm::dvec2(built().size - 1) / texels);
        scene.sky = SkyMap(256, gradientSky);
        if (baked) {
            scene.illumination =
                std::make_unique<TerrainIllumination>(scene.ground, scene.color, scene.sky, bake({}), 1.0f);
            scene.illumination->apply(scene.look, scene.color);
        }
        return scene;
    };
    const TerrainScene scenes[2] = {sceneOf(false), sceneOf(true)};
    const TerrainRenderer without(scenes[0]), with(scenes[1]);
    const double extent = ground().spacing().x * (ground().width() - 1);
    const Pose pose =
        poseFromAngles({-0.3 * extent, -0.3 * extent, ground().maxHeight() + 100.0}, 0.8, -0.3, 0);
    const StereoViews views = makeStereoViews(pose, {1280, 720, 0.8, 1.0, 1.0}, {50, 2000});
    EyeImage image;
    image.resize(1280, 720);
    double best[2] = {1e9, 1e9};
    for (int k = 0; k < 30; ++k) {
        best[0] = std::min(best[0], fastest_ms(1, [&] { renderEye(without, views.left, image); }));
        best[1] = std::min(best[1], fastest_ms(1, [&] { renderEye(with, views.left, image); }));
    }
    return {{"frame_ms", best[0]}, {"frame_baked_ms", best[1]}, {"frame_ratio", best[1] / best[0]}};
}

}  // namespace
}  // namespace stereonav::bench

int main(int argc, char** argv) {
    using namespace stereonav::bench;
    const bool marks = argc > 1 && std::strcmp(argv[1], "--marks") == 0;
    Json all;
    all.update(relightTimes());
    all.update(frameTimes());
    all.update(bakeRates());
    if (!marks) all["error"] = errors();
    std::printf("%s\n", all.dump(2).c_str());
    return 0;
}
