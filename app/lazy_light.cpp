// The same plan as that of `bake`, for the surface that is shown.
#include "app/lazy_light.h"

#include "app/light_loading.h"
#include "app/volume_light.h"
#include "engine/base/error.h"
#include "engine/light/seen_bricks.h"

namespace stereonav {

LazyLight::LazyLight(const SceneOptions& options, ColonScene& scene, Progress& progress) {
    BakeOptions bake;
    bake.scene = options;
    bake.probe = options.sky;
    bake.scene.sky.clear();
    bake.scene.light.clear();
    bake.bounces = 1;
    const VolumeBakePlan plan = planVolumeBake(scene, bake, progress);
    mLight = std::make_shared<IlluminationVolume>(plan.inputs.texels);
    mLighter = std::make_unique<TexelLighter>(scene.volume.field, plan.inputs.texels, plan.inputs.light,
                                              plan.inputs.sampling);
    mBake = std::make_unique<LazyBake>(scene.volume.field, plan.inputs.choice, sourceOf(*mLighter), *mLight);
    scene.volume.look.baked.light = mLight;
    scene.volume.look.baked.exposure = static_cast<float>(options.volume.exposure.value_or(1.0));
}

void refuseLazyLight(const SceneOptions& options) {
    if (options.light == kLazyLight)
        throw Error("--light", "", "lazy is expected with view or render",
                    "bake the light, and name its file");
}

void LazyLight::waitUntilDone() const {
    while (!mBake->waitUntilDone(60)) {
    }
}

void LazyLight::seen(const EyeView& view, const EyeImage& image) {
    mBake->request(bricksSeen(view, image, *mLight));
}

}  // namespace stereonav
