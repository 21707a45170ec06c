// Tables whose entries differ from one to the next, read by lanes close together and far apart: AVX-512 looks
// neighbouring entries up in registers (kernel_table_window.h), AVX2 gathers them. Both must say the same.
#include <random>

#include "engine/medium/sweep/medium_sweep.h"
#include "engine/simd/simd_target.h"
#include "sweep_scenes.h"

namespace stereonav {
namespace {

using test::makeField;

constexpr double kTableTolerance = 2e-6;  // approximate reciprocals differ; of light up to 1

// Points at every fourth entry or so, each of its own material: a wrong entry would be seen.
MediumTransfer raggedTransfer(bool ramp) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> u(0, 1);
    std::vector<MediumPoint> points;
    for (int n = 0; n <= 250; ++n) {
        MediumMaterial m;
        m.color = {u(random), u(random), u(random)};
        m.opacity = n % 7 == 3 ? 0 : 0.5 * u(random);
        m.transport = {0.3f + 0.7f * u(random), 0.3f + 0.7f * u(random), 0.3f + 0.7f * u(random)};
        m.surface = u(random);
        m.glow = {0.1f * u(random), 0, 0};
        points.push_back({4.0 * n, m});
    }
    MediumTransfer transfer(points, 0.4, "test");
    if (ramp) transfer.setSurfaceRamp(50, 2000, "test");
    return transfer;
}

MediumPicture pictureOf(const Medium& medium, double half, SimdTarget target) {
    MediumLook look;
    look.light = test::sun({-0.4, 0.8, -0.6});
    SweepSetting setting;
    setting.slices = 30;
    setting.lightSize = 24;
    const EyeView eye = test::viewFrom({1, -4, 1}, {0.05, 0, 0.02}, half, 33, 21);
    MediumSweep sweep(medium, target);
    MediumPicture picture;
    sweep.render(look, setting, {&eye, 1}, eye.head, 0, {&picture, 1});
    return picture;
}

double differenceOf(const MediumPicture& a, const MediumPicture& b) {
    double worst = 0;
    for (int y = 0; y < a.light.height(); ++y)
        for (int x = 0; x < a.light.width(); ++x)
            for (int k = 0; k < 4; ++k) {
                const double d = std::abs(a.light.at(x, y)[k] - b.light.at(x, y)[k]);
                worst = d <= worst ? worst : d;  // NaN is kept
            }
    return worst;
}

// Between sets whose products are fused: a ragged table turns the plain set's other rounding into more than
// the bound.
TEST(SweepTable, readsTheSameInRegistersAsGathered) {
    std::vector<SimdTarget> fused = simdTargets();
    std::erase(fused, SimdTarget::Plain);
    if (fused.size() < 2) GTEST_SKIP() << "fewer than two sets with fused products";
    struct Case {
        const char* name;
        std::function<double(const glm::ivec3&)> value;
    };
    const std::vector<Case> cases{
        {"constant", [](const glm::ivec3&) { return 501.0; }},
        {"first entry", [](const glm::ivec3&) { return 0.0; }},
        {"last entry", [](const glm::ivec3&) { return 1000.0; }},
        {"near the end", [](const glm::ivec3& v) { return 1000.0 - v.x; }},
        {"gentle", [](const glm::ivec3& v) { return 400.0 + 3 * v.x + 2 * v.y + v.z; }},
        {"steep", [](const glm::ivec3& v) { return 40.0 * v.x + 20 * v.y; }},
        {"ragged", [](const glm::ivec3& v) { return v.x * 7919 % 1001 + 0.0; }}};
    for (const bool ramp : {false, true})
        for (const Case& c : cases) {
            const Medium medium(makeField({17, 16, 15}, 2, {0, 0, 0}, c.value), raggedTransfer(ramp));
            for (const double half : {0.01, 0.1, 0.4}) {
                const MediumPicture gathered = pictureOf(medium, half, fused.front());
                for (const SimdTarget target : fused)
                    EXPECT_LE(differenceOf(gathered, pictureOf(medium, half, target)), kTableTolerance)
                        << nameOf(target) << ' ' << c.name << ' ' << half << ' ' << ramp;
            }
        }
}

}  // namespace
}  // namespace stereonav
