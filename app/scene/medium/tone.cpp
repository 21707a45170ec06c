#include "app/scene/medium/tone.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/medium/sweep/medium_sweep.h"

namespace stereonav {
namespace {

constexpr int kWidth = 160, kHeight = 90;       // pixels of the small picture
constexpr int kSlices = 128, kLightSize = 128;  // at most
constexpr float kRoom =
    1.3f;  // white over the brightest pixel: larger pictures and other views show brighter ones

}  // namespace

ToneCurve toneOf(const Scene& scene, const MediumScene& medium, SimdTarget simd) {
    Lens lens = scene.lens;
    lens.width = kWidth;
    lens.height = kHeight;
    lens.pixelAspect = 1;
    const EyeView view = makeEyeView(scene.startPose, lens);
    SweepSetting setting = medium.sweep;
    setting.slices = std::min(setting.slices, kSlices);
    setting.lightSize = std::min(setting.lightSize, kLightSize);
    MediumPicture picture;
    MediumSweep(medium.medium, simd)
        .render(medium.look, setting, {&view, 1}, view.head, 0, {&picture, 1}, {});
    float brightest = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::vec4& seen = picture.light.at(x, y);
            for (const float light : {seen.x, seen.y, seen.z})
                if (std::isfinite(light)) brightest = std::max(brightest, light);
        }
    ToneCurve tone;
    tone.white = std::max(kRoom * brightest, 1.0f);
    return tone;
}

}  // namespace stereonav
