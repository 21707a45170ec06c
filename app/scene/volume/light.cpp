// Baked light is read; transfer is multiplied with the sky's harmonics. The other models are those of Wyman
// et al. 2006, fig. 9: Lambert and Phong under one lamp beside the start pose, with and without hard shadows,
// ambient light that varies with the normal, fog.
#include "app/scene/volume/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/scene/volume/ambient.h"
#include "app/scene/volume/light_loading.h"
#include "engine/base/error.h"
#include "engine/light/skies/sky_probe.h"
#include "engine/light/transfer/light_beyond.h"
#include "engine/math/constants.h"
#include "engine/math/luminance.h"

namespace stereonav {
namespace {

constexpr float kMeanShown =
    0.45f;  // default radiance of white at the mean of the known texels, without --exposure

// Returns the mean light on white over the known texels; 0 where none is known.
double meanLight(const IlluminationVolume& light) {
    double sum = 0, weight = 0;
    const glm::ivec3 size = light.frame.size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const PackedTexel texel = light.texels[light.layout.index(i, j, k)];
                if (texel == 0) continue;
                const double w = texelWeight(texel);
                sum += w * luminance(glm::dvec3(texelLight(texel)));
                weight += w;
            }
    return weight > 0 ? sum / weight : 0.0;
}

std::shared_ptr<TurningSky> applyBaked(const SceneOptions& options, ColonScene& scene, Progress& progress) {
    BakedLight baked = loadBakedLight(options.light.file, scene, progress);
    BakedLook& look = scene.volume.look.baked;
    const bool transfer = baked.kind == BakeKind::Transfer;
    if (!transfer && (!options.sky.empty() || options.volume.skyMoved()))
        throw Error(options.light.file, "",
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
        // The product is formed in double: light and exposure may be far from 1, their product is not.
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

// Places the lamp above and to the left behind the viewer, at a distance of the size of the object.
void putLampAside(ColonScene& scene) {
    const VolumeFrame& frame = scene.volume.cells.frame;
    const glm::dvec3 extent = glm::dvec3(frame.size - 1) * frame.spacing;
    const glm::dvec3 middle = frame.worldFromVoxel(0.5 * glm::dvec3(frame.size - 1));
    const glm::dmat3 head(glm::mat3_cast(scene.startPose.orientation));
    VolumeLook& look = scene.volume.look;
    look.lampAt = middle + head * (glm::dvec3(-0.6, 0.8, 1.0) * glm::length(extent));
    look.falloff = 0;
}

void applyShading(Shading shading, ColonScene& scene) {
    if (shading == Shading::Lamp) return;
    putLampAside(scene);
    VolumeLook& look = scene.volume.look;
    if (shading != Shading::Phong && shading != Shading::PhongShadows) look.specular = 0;
    look.shadows = shading == Shading::LambertShadows || shading == Shading::PhongShadows;
    if (shading == Shading::Varying) look.ambient = 0.3f, look.varyingAmbient = 0.8f;
    if (shading != Shading::Fog) return;
    const VolumeFrame& frame = scene.volume.cells.frame;
    look.fog = static_cast<float>(glm::length(glm::dvec3(frame.size - 1) * frame.spacing));
}

}  // namespace

std::vector<glm::vec3> skyHarmonics(const SceneOptions& options, int order) {
    return (options.sky.empty() ? overcastSkyProbe() : readLightProbe(options.sky)).project(order);
}

SkyTurn skyTurnOf(const SceneOptions& options) {
    return {options.volume.turn_deg * kRadians, options.volume.tilt_deg * kRadians};
}

float exposureOf(const VolumeOptions& options, double meanLight) {
    const double chosen = meanLight > 0 ? static_cast<double>(kMeanShown) / meanLight : 1.0;
    return static_cast<float>(options.exposure.value_or(chosen));
}

std::shared_ptr<TurningSky> applyVolumeLight(const SceneOptions& options, ColonScene& scene,
                                             Progress& progress) {
    applyShading(options.volume.shading, scene);
    std::shared_ptr<TurningSky> sky;
    if (options.light.kind == LightChoice::Kind::File) sky = applyBaked(options, scene, progress);
    return sky;
}

}  // namespace stereonav
