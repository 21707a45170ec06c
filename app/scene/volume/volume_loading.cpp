#include "app/scene/volume/volume_loading.h"

#include <fmt/format.h>

#include "app/scene/volume/ambient.h"
#include "app/scene/volume/light.h"
#include "app/scene/volume/paint.h"
#include "app/scene/volume/studio.h"
#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "terrain/raster/elevation_folder.h"

namespace stereonav {
namespace {

constexpr double kMmPerMetre = 1000;

bool castsShadows(Shading shading) {
    return shading == Shading::LambertShadows || shading == Shading::PhongShadows;
}

// Throws Error for a shading whose lamp stands outside a closed wall that casts shadows: it would light
// nothing.
void checkShading(const VolumeOptions& volume, const VolumeSide& side) {
    if (castsShadows(volume.shading))
        side.expectOutside(
            "--shading",
            std::string(nameOf(volume.shading)) + " expects a volume seen from outside, this one is a colon",
            "add --isosurface, or use lambert or phong");
}

// Light is baked for the wall as it was then: usually for --look plain, which does not smooth masks.
bool isAsBaked(const SceneOptions& options) {
    return options.light.kind == LightChoice::Kind::File && !options.volume.maskSmoothing_mm;
}

MaskSmoothing maskSmoothingOf(const SceneOptions& options) {
    if (options.volume.maskSmoothing_mm) return *options.volume.maskSmoothing_mm / kMmPerMetre;
    return options.chosenLook && !isAsBaked(options) ? MaskSmoothing() : MaskSmoothing(0);
}

void expectMask(const SceneOptions& options, const ColonScene& colon) {
    if (options.volume.maskSmoothing_mm && !colon.maskSmoothed)
        throw Error("--mask-smoothing", "", "needs a mask, this study has grey values", "leave it out");
}

// Adds a note where a mask is not smoothed because its light is baked.
void noteMaskOfBake(const SceneOptions& options, ColonScene& colon) {
    if (options.chosenLook && isAsBaked(options) && colon.maskSmoothed)
        colon.notes.emplace_back(
            "the mask is not smoothed, as bake leaves it; --mask-smoothing in both commands smooths it");
}

// Adds a note where the folder holds ground as well: that is not opened.
void noteGround(const SceneOptions& options, std::vector<std::string>& notes) {
    if (!elevationFilesIn(options.scene).empty())
        notes.emplace_back(
            "left aside: elevation files in this folder; in one of their own they open as ground");
}

}  // namespace

ColonOptions colonOptionsOf(const SceneOptions& options) {
    const VolumeOptions& volume = options.volume;
    ColonOptions colon;
    if (options.scene != "colon") colon.study = options.scene;
    colon.reading.series = volume.series.value_or("");
    colon.reading.label = volume.label;
    colon.reading.resample = volume.resample;
    colon.segmentation.seeds = volume.seeds;
    colon.segmentation.choices = volume.choices;
    colon.segmentation.maskSmoothing = maskSmoothingOf(options);
    colon.segmentation.leavesFluid = volume.fluid == FluidChoice::Left;
    colon.centreline.reversed = volume.backwards;
    colon.isosurface = volume.isosurface;
    colon.isovalue = volume.isovalue;
    colon.transfer = volume.transfer;
    colon.opacity = volume.opacity;
    colon.cache = volume.cache;
    colon.up = volume.up;
    colon.wetWall = options.chosenLook;
    colon.chosen.values = options.chosenLook;
    colon.chosen.baked = options.light.kind == LightChoice::Kind::File;
    colon.chosen.view = options.chosenLook;
    colon.chosen.aspect = options.aspect;
    if (options.fov_deg) colon.chosen.fov = *options.fov_deg * kRadians;
    return colon;
}

LitVolume litVolumeOf(const SceneOptions& options, Progress& progress, bool keepsStudy) {
    LitVolume made;
    ColonOptions reading = colonOptionsOf(options);
    reading.keepsStudy = keepsStudy;
    Progress loading(progress, 0, 0.6), lighting(progress, 0.6, 0.65), occluding(progress, 0.65, 0.7),
        modulating(progress, 0.7, 0.8), standing(progress, 0.8, 0.9), choosing(progress, 0.9, 1);
    made.world = std::make_unique<VolumeWorld>(loadColon(reading, loading), options);
    ColonScene& colon = made.world->colon();
    VolumeLighting& light = made.light;
    checkShading(options.volume, made.world->side());
    noteGround(options, colon.notes);
    expectMask(options, colon);
    noteMaskOfBake(options, colon);
    light.sky = applyVolumeLight(options, colon, lighting);
    applyAmbient(options.volume, nullptr, colon, occluding);
    light.modulateSigma = applyModulation(options.volume, nullptr, std::nullopt, colon, modulating);
    if (light.modulateSigma)
        colon.notes.push_back(fmt::format("opacity modulated by {}, whole from {:.4g} on",
                                          nameOf(options.volume.modulate), *light.modulateSigma));
    applyStudio(options, nullptr, colon, standing);
    if (options.light.lazy()) light.lazy = std::make_shared<LazyLight>(options, colon, choosing);
    if (options.light.traced()) light.traced = std::make_shared<TracedLight>(options, colon);
    if (options.volume.isovalue) made.world->side().expectOutside("--isovalue");
    progress.report(1, "loaded");
    return made;
}

std::unique_ptr<Scene> loadColonScene(const SceneOptions& options, SimdTarget simd, Progress& progress) {
    Progress loading(progress, 0, 0.8), painting(progress, 0.8, 1);
    LitVolume lit = litVolumeOf(options, loading, paintNeedsStudy(options));
    VolumeWorld& world = *lit.world;
    auto scene = std::make_unique<ShownVolume>(std::move(lit), options, options, simd);
    scene->setPaint(wallPainters(world, options, scene->lens.verticalFov, painting));
    world.colon().study = {};
    progress.report(1, "loaded");
    return scene;
}

}  // namespace stereonav
