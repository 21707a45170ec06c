// A sweep keeps its buffers from frame to frame: whatever was asked for before, a frame is that of a sweep
// made anew, to the last bit.
#include <gtest/gtest.h>

#include <cstring>

#include "asked_sweeps.h"
#include "engine/medium/sweep/medium_sweep.h"
#include "sweep_scenes.h"

namespace stereonav::test {
namespace {

// A ball whose outer part is a surface, in noise that moves.
Medium reusedMedium(std::shared_ptr<GreyVolume> field) {
    std::vector<MediumPoint> points(3);
    points[0].value = 500;
    points[1].value = 6000;
    points[1].material = {{0.9f, 0.6f, 0.3f}, 0.5, {0.9f, 0.7f, 0.5f}, 0.8, {0.1f, 0, 0}};
    points[2].value = 20000;
    points[2].material = {{0.3f, 0.8f, 0.95f}, 0.8, {0.6f, 0.8f, 0.9f}, 0.2, {}};
    Perturbation noise;
    noise.scales.resize(1);
    noise.scales[0] = {1.2, 0.06, 0.5f, {0.2f, -0.3f, 0.1f}, {0.3f, 0.2f, -0.4f}, {0.1, 0, -0.2}};
    return Medium(std::move(field), MediumTransfer(points, 0.2, "test"), noise);
}

AskedSweep firstAsked(const VolumeFrame& frame, MediumLight::Kind kind) {
    AskedSweep asked;
    asked.look.light = sun({0.3, 0.8, -0.4});
    asked.look.light.kind = kind;
    asked.look.light.position = -1.4 * asked.look.light.direction;
    asked.look.light.coneAngle = 1.2;
    asked.look.light.falloff = 1.5;
    asked.look.phase = PhaseFunction::henyeyGreenstein({0.3f, 0.2f, 0.1f});
    asked.look.indirectShare = 0.75f;
    asked.look.baked.light = anyLight(frame, 6);
    asked.look.baked.lampShare = 0.25f;
    asked.setting.slices = 24;
    asked.setting.lightSize = 40;
    asked.setting.coneAngle = 1;
    asked.setting.blurLength = 0.1;
    for (const double x : {0.4, 0.5}) {
        EyeView eye = viewFrom({x, -3, 0.7}, {0, 0, 0}, 0.4, 26, 22);
        eye.head = {0.45, -3, 0.7};
        asked.eyes.push_back(eye);
    }
    asked.time = 2;
    return asked;
}

std::vector<MediumPicture> sweptBy(MediumSweep& sweep, const AskedSweep& asked) {
    std::vector<MediumPicture> pictures(asked.eyes.size());
    sweep.render(asked.look, asked.setting, asked.eyes, asked.eyes[0].head, asked.time, pictures);
    return pictures;
}

template <typename T>
bool sameBits(const Plane<T>& a, const Plane<T>& b) {
    bool same = a.width() == b.width() && a.height() == b.height();
    for (int y = 0; same && y < a.height(); ++y)
        same = std::memcmp(a.row(y), b.row(y), sizeof(T) * static_cast<std::size_t>(a.width())) == 0;
    return same;
}

bool samePictures(const std::vector<MediumPicture>& a, const std::vector<MediumPicture>& b) {
    bool same = a.size() == b.size();
    for (std::size_t n = 0; same && n < a.size(); ++n)
        same = sameBits(a[n].light, b[n].light) && sameBits(a[n].viewDepth, b[n].viewDepth);
    return same;
}

TEST(SweepReuse, AFrameIsThatOfASweepMadeAnew) {
    const std::shared_ptr<GreyVolume> field = makeField({25, 25, 25}, 2, {0, 0, 0}, [](const glm::ivec3& v) {
        const double r = glm::length(glm::dvec3(v - 12)) / 12;
        return r < 1 ? 20000 * (1 - r * r) : 0.0;
    });
    const Medium medium = reusedMedium(field);
    for (const auto kind : {MediumLight::Kind::Lamp, MediumLight::Kind::Parallel}) {
        const AskedSweep base = firstAsked(field->frame, kind);
        const auto anew = [&](const AskedSweep& asked) {
            MediumSweep sweep(medium);
            return sweptBy(sweep, asked);
        };
        MediumSweep reused(medium);
        const std::vector<MediumPicture> first = anew(base);
        EXPECT_TRUE(samePictures(sweptBy(reused, base), first));
        int different = 0;
        for (const Changed<AskedSweep>& changed : sweepsBeside(base, field->frame)) {
            const std::vector<MediumPicture> expected = anew(changed.value);
            EXPECT_TRUE(samePictures(sweptBy(reused, changed.value), expected)) << changed.what;
            EXPECT_TRUE(samePictures(sweptBy(reused, base), first)) << "after " << changed.what;
            different += !samePictures(expected, first);
        }
        EXPECT_GT(different, 40) << "hardly anything changes the picture";
    }
}

}  // namespace
}  // namespace stereonav::test
