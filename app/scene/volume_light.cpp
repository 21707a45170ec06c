// Baked light is read and, if it is transfer, dotted with the sky. The other models are those of Wyman et al.
// 2006, fig. 9: Lambert and Phong under one lamp beside the start pose, with and without hard shadows,
// ambient light that varies with the normal, fog.
#include "app/scene/volume_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/scene/light_loading.h"
#include "app/scene/volume_ambient.h"
#include "engine/base/error.h"
#include "engine/light/skies/sky_probe.h"
#include "engine/light/transfer/light_beyond.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr float kMeanShown =
    0.45f;  // radiance of white at the mean of the known texels, where nothing is said

// Of white, over the texels that are known; 0 where none is.
double meanLight(const IlluminationVolume& light) {
    double sum = 0, weight = 0;
    const glm::ivec3 size = light.frame.size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const PackedTexel texel = light.texels[light.layout.index(i, j, k)];
                if (texel == 0) continue;
                const double w = texelWeight(texel);
                sum += w * glm::dot(glm::dvec3(texelLight(texel)), glm::dvec3(0.2126, 0.7152, 0.0722));
                weight += w;
            }
    return weight > 0 ? sum / weight : 0.0;
}

std::shared_ptr<TurningSky> applyBaked(const SceneOptions& options, ColonScene& scene, Progress& progress) {
    BakedLight baked = loadBakedLight(options.light, scene, progress);
    BakedLook& look = scene.volume.look.baked;
    const bool transfer = baked.kind == BakeKind::Transfer;
    if (!transfer && (!options.sky.empty() || options.volume.skyMoved()))
        throw Error(options.light, "",
                    "expected baked transfer, to be lit by a sky, got light that stands still",
                    "bake with --what transfer, or leave out --sky, --turn and --tilt");
    auto light = std::make_shared<IlluminationVolume>(transfer ? IlluminationVolume(baked.transfer.frame())
                                                               : std::move(baked.irradiance));
    std::vector<glm::vec3> straight;
    if (transfer) {
        straight = skyHarmonics(options, baked.transfer.order());
        baked.transfer.relightAll(turnedSky(straight, skyTurnOf(options)), *light);
    }
    if (baked.kind == BakeKind::Openness) {
        if (options.volume.exposure)
            throw Error("--exposure", "", "has no effect on openness, which weakens the lamp's light",
                        "leave it out");
        look.use = BakedLook::Use::Openness;
    } else {
        // In double: light and exposure may be far from 1, their product is not.
        const auto unit = static_cast<double>(baked.unit);
        look.exposure = static_cast<float>(
            static_cast<double>(exposureOf(options.volume, meanLight(*light) * unit)) * unit);
    }
    look.light = light;
    auto beyond = std::make_shared<IlluminationVolume>(lightBeyond(*light));
    look.beyond = beyond;
    if (!transfer || !options.skyTurns) return nullptr;
    return std::make_shared<TurningSky>(std::move(baked.transfer), std::move(straight), std::move(light),
                                        skyTurnOf(options), std::move(beyond));
}

// Up and to the left behind the one who looks, as far away as what is looked at is large.
void putLampAside(ColonScene& scene) {
    const VolumeFrame& frame = scene.volume.cells.frame;
    const glm::dvec3 extent = glm::dvec3(frame.size - 1) * frame.spacing;
    const glm::dvec3 middle = frame.worldFromVoxel(0.5 * glm::dvec3(frame.size - 1));
    const glm::dmat3 head(glm::mat3_cast(scene.startPose.orientation));
    VolumeLook& look = scene.volume.look;
    look.lampAt = middle + head * (glm::dvec3(-0.6, 0.8, 1.0) * glm::length(extent));
    look.falloff = 0;
}

struct Shading {
    const char* name;
    std::function<void(ColonScene&)> apply;
};

const std::array<Shading, 7>& shadings() {
    static const std::array<Shading, 7> all{{
        {"lamp", [](ColonScene&) {}},
        {"lambert", [](ColonScene& s) { putLampAside(s), s.volume.look.specular = 0; }},
        {"lambert-shadows",
         [](ColonScene& s) { putLampAside(s), s.volume.look.specular = 0, s.volume.look.shadows = true; }},
        {"phong", [](ColonScene& s) { putLampAside(s); }},
        {"phong-shadows", [](ColonScene& s) { putLampAside(s), s.volume.look.shadows = true; }},
        {"varying",
         [](ColonScene& s) {
             putLampAside(s);
             s.volume.look.specular = 0, s.volume.look.ambient = 0.3f, s.volume.look.varyingAmbient = 0.8f;
         }},
        {"fog",
         [](ColonScene& s) {
             putLampAside(s);
             const VolumeFrame& frame = s.volume.cells.frame;
             s.volume.look.specular = 0;
             s.volume.look.fog = static_cast<float>(glm::length(glm::dvec3(frame.size - 1) * frame.spacing));
         }},
    }};
    return all;
}

const Shading& shadingOf(const std::string& name) {
    for (const Shading& shading : shadings())
        if (name == shading.name) return shading;
    throw Error("--shading", "", fmt::format("\"{}\" is not known", name),
                "expected one of " + shadingNames());
}

}  // namespace

std::vector<glm::vec3> skyHarmonics(const SceneOptions& options, int order) {
    return (options.sky.empty() ? overcastSkyProbe() : readLightProbe(options.sky)).project(order);
}

SkyTurn skyTurnOf(const SceneOptions& options) {
    return {options.volume.turn_deg * kRadians, options.volume.tilt_deg * kRadians};
}

std::string shadingNames() {
    std::string names;
    for (const Shading& shading : shadings())
        names += (names.empty() ? "" : ", ") + std::string(shading.name);
    return names;
}

float exposureOf(const VolumeOptions& options, double meanLight) {
    const double chosen = meanLight > 0 ? static_cast<double>(kMeanShown) / meanLight : 1.0;
    return static_cast<float>(options.exposure.value_or(chosen));
}

std::shared_ptr<TurningSky> applyVolumeLight(const SceneOptions& options, ColonScene& scene,
                                             Progress& progress) {
    const VolumeOptions& volume = options.volume;
    if (!volume.shading.empty()) shadingOf(volume.shading).apply(scene);
    const bool file = !options.light.empty() && !isLazyLight(options.light) && options.light != kTracedLight;
    std::shared_ptr<TurningSky> sky;
    if (file) sky = applyBaked(options, scene, progress);
    return sky;
}

}  // namespace stereonav
