#include "app/scene/colon_loading.h"

#include <fmt/format.h>

#include "app/options/option_numbers.h"
#include "app/scene/volume_ambient.h"
#include "app/scene/volume_light.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

glm::dvec3 seedFromText(const std::string& text) {
    const std::vector<double> n = numbersIn("--seed", seedNumbers(), text).numbers;
    return glm::dvec3(n[0], n[1], n[2]) / 1000.0;
}

std::optional<UpAxis> upFromText(const std::optional<std::string>& text) {
    if (!text) return std::nullopt;
    if (const std::optional<UpAxis> up = upAxisFromText(*text)) return up;
    throw Error("--up", "", "expected x, -x, y, -y, z or -z, got \"" + *text + "\"",
                "-z stands a volume on its head");
}

bool castsShadows(const std::string& shading) {
    return shading.ends_with("-shadows");
}

// A lamp outside lights nothing of a closed wall that casts shadows.
void checkShading(const VolumeOptions& volume, const ColonScene& scene) {
    if (scene.isColon() && castsShadows(volume.shading))
        throw Error("--shading", "",
                    volume.shading + " expects a volume seen from outside, this one is a colon",
                    "add --isosurface, or use lambert or phong");
}

}  // namespace

ColonOptions colonOptionsOf(const SceneOptions& options) {
    const VolumeOptions& volume = options.volume;
    ColonOptions colon;
    if (options.scene != "colon") colon.study = options.scene;
    colon.reading.series = volume.series;
    colon.reading.label = volume.label;
    colon.reading.resample = volume.resample;
    for (const std::string& seed : volume.seeds) colon.segmentation.seeds.push_back(seedFromText(seed));
    colon.centreline.reversed = volume.backwards;
    colon.isosurface = volume.isosurface;
    colon.isovalue = volume.isovalue;
    colon.transfer = volume.transfer;
    colon.opacity = volume.opacity;
    colon.cache = volume.cache;
    colon.up = upFromText(volume.up);
    return colon;
}

LitVolume litVolumeOf(const SceneOptions& options, Progress& progress) {
    checkAmbientLight(options.volume);
    LitVolume made;
    made.world = std::make_unique<VolumeWorld>(loadColon(colonOptionsOf(options), progress), options);
    ColonScene& colon = made.world->colon();
    VolumeLighting& light = made.light;
    checkShading(options.volume, colon);
    light.sky = applyVolumeLight(options, colon, progress);
    applyAmbient(options.volume, nullptr, colon, progress);
    light.modulateSigma = applyModulation(options.volume, nullptr, std::nullopt, colon, progress);
    if (light.modulateSigma)
        colon.notes.push_back(fmt::format("opacity modulated by {}, whole from {:.4g} on",
                                          options.volume.modulate, *light.modulateSigma));
    if (isLazyLight(options.light)) light.lazy = std::make_shared<LazyLight>(options, colon, progress);
    if (options.light == kTracedLight) light.traced = std::make_shared<TracedLight>(options, colon);
    if (options.volume.isovalue && colon.isColon())
        throw Error("--isovalue", "", "expected with a volume seen from outside, this one is a colon",
                    "add --isosurface, or leave it out");
    return made;
}

std::unique_ptr<Scene> loadColonScene(const SceneOptions& options, SimdTarget simd, Progress& progress) {
    return std::make_unique<ShownVolume>(litVolumeOf(options, progress), options, options, simd);
}

}  // namespace stereonav
