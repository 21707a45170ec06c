// Paths and the sweep's reference model, which share nothing but the medium, must meet where both are right:
// direct light in many thin slabs.
#include <gtest/gtest.h>

#include <array>

#include "tests/medium/delta_tracking_scenes.h"
#include "tests/oracle/plain_sweep.h"

namespace stereonav {
namespace {

// A smooth blob, 2 m wide, denser on one side.
Medium blob() {
    VolumeFrame frame;
    frame.size = {24, 24, 24};
    frame.spacing = glm::dvec3(2.0 / 23);
    frame.origin = glm::dvec3(-1.0);
    auto field = std::make_shared<GreyVolume>(frame);
    for (int k = 0; k < 24; ++k)
        for (int j = 0; j < 24; ++j)
            for (int i = 0; i < 24; ++i) {
                const glm::dvec3 p = frame.worldFromVoxel({i, j, k});
                const double value = 1000 * std::exp(-3 * glm::dot(p, p)) * (1 + 0.4 * p.x);
                field->at(i, j, k) = static_cast<std::int16_t>(std::lround(value));
            }
    const MediumTransfer transfer({{10, materialOf(0, {1, 0.9f, 0.8f})},
                                   {500, materialOf(2, {1, 0.7f, 0.4f}, {0, 0.05f, 0})},
                                   {1500, materialOf(8, {0.9f, 0.9f, 0.2f})}},
                                  kReference, "blob");
    return Medium(field, transfer);
}

EyeView viewOfBlob() {
    EyeView view = narrowView({0.3, 0.5, -0.8}, 5);
    view.xMin = view.yMin = -0.25;
    view.xMax = view.yMax = 0.25;
    return view;
}

void expectSame(const MediumLook& look) {
    const Medium medium = blob();
    const EyeView view = viewOfBlob();
    SweepSetting fine;
    fine.slices = 160;
    fine.lightSize = 128;
    const auto geometry = makeSweepGeometry(medium, look, fine, std::array{view}, view.head);
    const MediumPicture model = std::move(plainSweep(medium, look, fine, geometry).front());
    TrackingSetting setting;
    setting.samples = 3000;
    const TrackedPicture paths = trackPicture(medium, look, view, setting);
    int lit = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::vec4 there = paths.light.at(x, y), here = model.light.at(x, y);
            EXPECT_NEAR(here.w, there.w, 0.02) << x << ' ' << y;
            for (int c = 0; c < 3; ++c) {
                // 0.5 % for the slabs and the light's texels.
                const double deviation = std::sqrt(paths.variance.at(x, y)[c]);
                EXPECT_NEAR(here[c], there[c], kStated_z * deviation + 0.005 * there[c] + 1e-4)
                    << x << ' ' << y << " channel " << c;
                lit += there[c] > 20 * deviation;
            }
        }
    EXPECT_GT(lit, 60);
}

TEST(DeltaTrackingAndSweep, DirectLightFromTheViewersSide) {
    MediumLook look = litLook({-0.2, 0.7, -0.7});
    look.phase = PhaseFunction::henyeyGreenstein({0.3f, 0.0f, -0.3f});
    expectSame(look);
}

TEST(DeltaTrackingAndSweep, DirectLightTowardsTheViewer) {
    MediumLook look = litLook({-0.6, -0.2, 0.7});
    look.phase = PhaseFunction::henyeyGreenstein({0.3f, 0.0f, -0.3f});
    expectSame(look);
}

TEST(DeltaTrackingAndSweep, Lamp) {
    MediumLook look = litLook({0.3, 0.6, -0.8});
    look.light.kind = MediumLight::Kind::Lamp;
    look.light.position = -3.0 * look.light.direction;
    look.light.coneAngle = 1.2;
    look.light.falloff = 2;
    look.light.radiance = glm::vec3(5.0f);
    expectSame(look);
}

TEST(DeltaTrackingAndSweep, Emission) {
    expectSame(litLook({0, 0, -1}, MediumModel::Emission));
}

}  // namespace
}  // namespace stereonav
