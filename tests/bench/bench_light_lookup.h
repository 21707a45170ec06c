// What a frame costs under baked light beside plain diffuse shading and hard shadow rays (Wyman et al. 2006,
// Table 2): 512x512 pixels of the subject from outside, all threads, fastest of many frames in turn.
#pragma once

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

#include "colon/scene/isosurface_scene.h"
#include "engine/base/parallel.h"
#include "engine/base/progress.h"
#include "engine/base/stopwatch.h"
#include "engine/camera/stereo_rig.h"
#include "engine/light/paths/texel_light.h"
#include "engine/light/transfer/bake_texels.h"
#include "engine/light/transfer/seen_bricks.h"
#include "engine/light/transfer/transfer_volume.h"
#include "engine/volume/volume_renderer.h"
#include "tests/bench/bench_light_subject.h"

namespace stereonav::bench {

struct LookupTimes {
    double diffuse_ms, shadowed_ms, irradiance_ms, seen_ms, relight_ms, relightAll_ms;
    std::size_t texels, texelsSeen;
};

// One picture after another, so that what disturbs the machine disturbs all alike.
class FrameTimes {
public:
    FrameTimes(const VolumeScene& scene, const EyeView& view) : mRenderer(scene), mView(view) {
        mImage.resize(view.width, view.height, mRenderer.viewDependence());
    }
    void run() {
        const Stopwatch watch;
        renderEye(mRenderer, mView, mImage);
        mLeast_ms = std::min(mLeast_ms, watch.elapsed_ms());
    }
    double least_ms() const { return mLeast_ms; }
    const EyeImage& image() const { return mImage; }

private:
    VolumeRenderer mRenderer;
    EyeView mView;
    EyeImage mImage;
    double mLeast_ms = 1e300;
};

inline ColonScene lookupScene(const LightSubject& subject) {
    GreyVolume grey(subject.volume.frame);
    std::copy_n(subject.volume.values.data(), grey.values.size(), grey.values.data());
    grey.scale = subject.volume.scale;
    grey.offset = subject.volume.offset;
    Progress progress;
    ColonScene scene = isosurfaceScene(std::move(grey), {}, progress);
    VolumeLook& look = scene.volume.look;
    look.specular = 0;
    look.falloff = 0;
    look.lampAt = scene.startPose.position + glm::dvec3(0.05, -0.1, 0.3);
    return scene;
}

inline LookupTimes measureLookup(const LightSubject& subject, int order, int frames) {
    ColonScene scene = lookupScene(subject);
    Lens lens = scene.lens;
    lens.width = lens.height = 512;
    const EyeView view = makeEyeView(scene.startPose, lens);
    FrameTimes diffuse(scene.volume, view);
    scene.volume.look.shadows = true;
    FrameTimes shadowed(scene.volume, view);
    scene.volume.look.shadows = false;

    const VolumeFrame texels = texelFrame(scene.volume.field.frame, 1);
    const float isovalue = scene.volume.cells.isovalue;
    Progress progress;
    const std::vector<TexelBrick> bricks =
        wantedBricks(scene.volume.field, texels, {isovalue, isovalue, nullptr, false}, progress);
    TransferVolume transfer(texels, order, 1, bricks);
    std::vector<float> numbers;
    for (std::size_t n = 0; n < bricks.size(); ++n) {
        numbers.assign(
            static_cast<std::size_t>(countTexels(bricks[n].wanted)) * static_cast<std::size_t>(order * order),
            0.1f);
        transfer.setBrick(n, numbers);
    }
    auto light = std::make_shared<IlluminationVolume>(texels);
    const std::vector<glm::vec3> sky(static_cast<std::size_t>(order * order), glm::vec3(0.5f));
    transfer.relightAll(sky, *light);
    scene.volume.look.baked.light = light;
    FrameTimes irradiance(scene.volume, view);
    double seen_ms = 1e300, relight_ms = 1e300, relightAll_ms = 1e300;
    std::vector<std::uint32_t> held;
    for (int n = 0; n < frames; ++n) {
        diffuse.run();
        shadowed.run();
        irradiance.run();
        Stopwatch watch;
        held = transfer.heldAmong(bricksSeen(view, irradiance.image(), *light));
        seen_ms = std::min(seen_ms, watch.lap_ms());
        transfer.relight(sky, held, *light);
        relight_ms = std::min(relight_ms, watch.lap_ms());
        transfer.relightAll(sky, *light);
        relightAll_ms = std::min(relightAll_ms, watch.lap_ms());
    }
    std::size_t texelsSeen = 0;
    for (const std::uint32_t n : held) texelsSeen += static_cast<std::size_t>(countTexels(bricks[n].wanted));
    return {diffuse.least_ms(), shadowed.least_ms(), irradiance.least_ms(), seen_ms,
            relight_ms,         relightAll_ms,       transfer.texels(),     texelsSeen};
}

inline void printLookup(const LookupTimes& t, bool marksOnly) {
    if (!marksOnly)
        std::printf(
            "\n512x512: diffuse %.2f ms, with hard shadow rays %.2f, irradiance looked up %.2f; harmonics of "
            "%zu texels dotted with a turned sky %.2f ms, the %zu in view %.2f and %.2f to find them\n",
            t.diffuse_ms, t.shadowed_ms, t.irradiance_ms, t.texels, t.relightAll_ms, t.texelsSeen,
            t.relight_ms, t.seen_ms);
    std::printf("lookup_vs_diffuse %.3f\n", t.irradiance_ms / t.diffuse_ms);
    std::printf("transfer_vs_diffuse %.3f\n", (t.irradiance_ms + t.seen_ms + t.relight_ms) / t.diffuse_ms);
    std::printf("shadow_rays_vs_diffuse %.3f\n", t.shadowed_ms / t.diffuse_ms);
}

}  // namespace stereonav::bench
