// The light is that of `bake`; the exposure of both pictures is chosen by the left one.
#include "app/scene/volume/traced_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/scene/volume/light.h"
#include "app/scene/volume/light_loading.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

constexpr int kTracedSamples = 64;  // default

// Returns the same light as options of a bake.
BakeOptions asBake(const SceneOptions& options) {
    const TracedOptions traced = options.traced.value_or(TracedOptions{});
    BakeOptions bake;
    bake.scene = options;
    bake.scene.light = {};
    bake.scene.volume.cache = true;  // for bakes only; pictures store nothing in the cache
    bake.words = {"--point-light", "--sky"};
    bake.probe = options.sky;
    bake.scene.sky.clear();
    bake.sky = options.skyColor;
    bake.samples = traced.samples;
    bake.bounces = traced.bounces;
    bake.albedo = traced.albedo;
    bake.lights = traced.lights;
    bake.reach_mm = traced.reach_mm;
    return bake;
}

std::string tracedErrorText(double error) {
    return std::isfinite(error) ? fmt::format("error at most about {:.2g} %", 100 * error)
                                : "error not known";
}

}  // namespace

std::string methodUnderLight(const SceneOptions& options, const std::string& method) {
    return options.light.traced() ? "full" : method;
}

TracedLight::TracedLight(const SceneOptions& options, const ColonScene& scene)
    : mOptions(options.volume),
      mScene(scene),
      mSamples(options.traced.value_or(TracedOptions{}).samples.value_or(kTracedSamples)) {
    const LightSetup setup = lightSetupOf(scene, asBake(options), mNotes);
    mPaths = std::make_unique<PixelPaths>(scene.volume, setup);
}

void TracedLight::light(const StereoViews& views, EyeImage& left, EyeImage& right, Progress& progress) {
    const Stopwatch watch;
    PixelLightFacts facts;
    float exposure = 1;
    std::uint32_t eye = 0;
    for (const auto& [view, image] : {std::pair{&views.left, &left}, std::pair{&views.right, &right}}) {
        Plane<TexelSum> sums;
        Progress half([&](double share, const std::string& what) {
            progress.report((eye + share) / 2, fmt::format("{} eye, {}", eye ? "right" : "left", what));
        });
        mPaths->add(*view, image->viewDepth, eye, mSamples, sums, half);
        if (eye == 0) {
            facts = factsOf(sums);
            exposure = exposureOf(mOptions, facts.mean);
        }
        showPixelLight(mScene.volume.look, sums, exposure, *image);
        ++eye;
    }
    mNotes.push_back(fmt::format("both eyes traced in {:.2f} s, {} paths a pixel, {}, exposure {:.4g}",
                                 watch.elapsed_ms() / 1000, mSamples, tracedErrorText(facts.error),
                                 static_cast<double>(exposure)));
}

}  // namespace stereonav
