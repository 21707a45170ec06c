// The sweep in GLSL keeps programs, targets and textures from frame to frame. Whatever was rendered before,
// each frame must equal the reference model's.
#include "tests/display/medium_gpu_subject.h"
#include "tests/medium/asked_sweeps.h"

namespace stereonav::gpu_test {
namespace {

using MediumGpuReuse = MediumGpuTest;

TEST_F(MediumGpuReuse, AFrameIsByTheBookWhateverCameBefore) {
    const std::shared_ptr<GreyVolume> field = blobs();
    Subject subject(Medium(field, transfer(0.5, 0.2f), twoScales()));
    test::AskedSweep base;
    base.look = lookOf(MediumModel::Indirect, {0.3, 0.8, -0.4});
    base.look.light.kind = MediumLight::Kind::Lamp;
    base.look.light.position = kMiddle - 1.4 * base.look.light.direction;
    base.look.light.coneAngle = 1.2;
    base.look.light.falloff = 1.5;
    base.look.phase = PhaseFunction::henyeyGreenstein({0.3f, 0.2f, 0.1f});
    base.look.baked.light = test::anyLight(field->frame, 6);
    base.look.baked.lampShare = 0.25f;
    base.setting = smallSetting();
    base.setting.blurLength = 0.1;
    for (const double x : {0.0, 0.1}) {
        base.eyes.push_back(viewFrom(kEye + glm::dvec3(x, 0, 0), kMiddle, 14, 12));
        base.eyes.back().head = kEye;
    }
    base.time = 2;
    const auto expectIt = [&](const test::AskedSweep& asked) {
        expectAsByTheBook(subject, asked.look, asked.eyes, asked.setting, asked.time);
    };
    expectIt(base);
    for (const auto& changed : test::sweepsBeside(base, field->frame)) {
        if (changed.what.ends_with("by a little")) continue;  // too small a change for a picture to show
        SCOPED_TRACE(changed.what);
        expectIt(changed.value);
        if (HasFailure()) return;
    }
    expectIt(base);
}

}  // namespace
}  // namespace stereonav::gpu_test
