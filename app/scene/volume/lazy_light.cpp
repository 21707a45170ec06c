// The bake is planned as by `bake`, for the surface that is shown.
#include "app/scene/volume/lazy_light.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "app/scene/volume/light.h"
#include "app/scene/volume/light_loading.h"
#include "app/scene/volume/side.h"
#include "engine/light/transfer/seen_bricks.h"
#include "engine/math/luminance.h"

namespace stereonav {
LazyLight::LazyLight(const SceneOptions& options, ColonScene& scene, Progress& progress)
    : mField(scene.volume.field.share()), mRegion(scene.lumen.lumen.share()) {
    BakeOptions bake;
    bake.scene = options;
    bake.probe = options.sky;
    bake.scene.sky.clear();
    bake.scene.light = {};
    bake.bounces = 1;
    const bool transfer = options.light.kind == LightChoice::Kind::LazyTransfer;
    sideOf(scene)->checkLazyLight(transfer, !options.sky.empty());
    if (transfer) bake.what = BakeKind::Transfer;
    const VolumeBakePlan plan = planVolumeBake(scene, bake, progress);
    mLight = std::make_shared<IlluminationVolume>(plan.inputs.texels);
    mChoice = plan.inputs.choice;
    if (mChoice.region) mChoice.region = &mRegion;
    // The surface may be moved later, so texels far from the present one are lit by their own values.
    mLighter =
        std::make_unique<TexelLighter>(mField, plan.inputs.texels, plan.inputs.light, plan.inputs.sampling);
    LazyBakeSetting setting;
    setting.shape = plan.inputs.shape;
    mBake = std::make_unique<LazyBake>(mField, mChoice, sourceOf(*mLighter), *mLight, setting);
    double mean = 1;  // mean of the sky
    if (const auto& probe = plan.inputs.light.probe) mean = luminance(glm::dvec3(probe->mean()));
    if (transfer) {
        mStraight = skyHarmonics(options, setting.shape.order);
        mean = luminance(glm::dvec3(mStraight[0])) / std::sqrt(4 * std::numbers::pi);
        mTurn = skyTurnOf(options);
        mBake->setLight(turnedSky(mStraight, mTurn));
    }
    BakedLook& look = scene.volume.look.baked;
    look.light = mLight;
    // Exposure is that of a sky of 1 all around: the texels that will be lit are not known yet.
    look.exposure = static_cast<float>(options.volume.exposure.value_or(mean > 0 ? 1 / mean : 1.0));
}

void LazyLight::showSurface(float isovalue) {
    if (mChoice.lowest == isovalue && mChoice.highest == isovalue) return;
    mChoice.lowest = mChoice.highest = isovalue;
    mBake->setChoice(mChoice);
}

void LazyLight::turnTo(const SkyTurn& turn) {
    if (turn == mTurn) return;
    mTurn = turn;
    mBake->setLight(turnedSky(mStraight, turn));
}

void LazyLight::waitUntilDone() const {
    while (!mBake->waitUntilDone(60)) {
    }
}

// During a flight a sample of the pixels is enough. It misses bricks at edges and on slopes seen at a grazing
// angle, which would stay dark in a picture that rests.
void LazyLight::seen(const EyeView& view, const EyeImage& image) {
    constexpr int kSparse = 4;
    const std::array<glm::dvec3, 3> place{view.eye, view.rayDirection(0, 0),
                                          view.rayDirection(view.width, view.height)};
    const bool still = std::exchange(mPlace, place) == place;
    mBake->request(bricksSeen(view, image, *mLight, still ? 1 : kSparse));
    if (!still) ++mLooks;
}

}  // namespace stereonav
