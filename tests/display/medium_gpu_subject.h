// Small media, views and looks for the tests of the sweep in GLSL, and its comparison with the reference
// model (plain_sweep.h). Needs no display.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "engine/display/medium_gpu.h"
#include "tests/display/egl_context.h"
#include "tests/oracle/plain_sweep.h"

namespace stereonav::gpu_test {

inline const glm::dvec3 kMiddle{51000.25, -30000.5, 800.125};  // middle of the medium: far from the origin

inline EyeView viewFrom(const glm::dvec3& eye, const glm::dvec3& at, int width = 24, int height = 20) {
    EyeView view;
    view.eye = view.head = eye;
    view.forward = glm::normalize(at - eye);
    view.right = glm::normalize(glm::cross(view.forward, glm::dvec3(0, 0, 1)));
    view.up = glm::cross(view.right, view.forward);
    view.xMax = 0.5;
    view.xMin = -0.5;
    view.yMax = 0.5 * height / width;
    view.yMin = -view.yMax;
    view.width = width;
    view.height = height;
    return view;
}

// 16^3 voxels, 1.5 m wide, turned and stretched; smooth blobs, values 0..1000.
inline std::shared_ptr<GreyVolume> blobs(double scale = 1, double offset = 0) {
    VolumeFrame frame;
    frame.size = {16, 15, 17};
    frame.spacing = {0.1, 0.09, 0.11};
    frame.axes = glm::dmat3(glm::dvec3(0.8, 0.6, 0), glm::dvec3(-0.6, 0.8, 0), glm::dvec3(0, 0, 1));
    frame.origin = kMiddle - frame.axes * (frame.spacing * glm::dvec3(frame.size - 1) * 0.5);
    auto field = std::make_shared<GreyVolume>(frame);
    field->scale = scale;
    field->offset = offset;
    for (int k = 0; k < 17; ++k)
        for (int j = 0; j < 15; ++j)
            for (int i = 0; i < 16; ++i) {
                const double a =
                    std::exp(-0.08 * (std::pow(i - 6, 2) + std::pow(j - 7, 2) + std::pow(k - 9, 2)));
                const double b =
                    std::exp(-0.1 * (std::pow(i - 10, 2) + std::pow(j - 9, 2) + std::pow(k - 6, 2)));
                const double value = std::min(1000.0, 900 * a + 700 * b);
                field->at(i, j, k) = static_cast<std::int16_t>((value - offset) / scale);
            }
    return field;
}

inline MediumTransfer transfer(double surface = 0, float glow = 0) {
    std::vector<MediumPoint> points(3);
    points[0].value = 150;
    points[1].value = 450;
    points[1].material = {{0.9f, 0.6f, 0.3f}, 0.5, {0.9f, 0.7f, 0.5f}, surface, glm::vec3(glow, 0, 0)};
    points[2].value = 900;
    points[2].material = {{0.3f, 0.8f, 0.95f}, 0.8, {0.6f, 0.8f, 0.9f}, 0.5 * surface, glm::vec3(0, glow, 0)};
    return {points, 0.2, "test"};
}

inline MediumLook lookOf(MediumModel model, const glm::dvec3& direction) {
    MediumLook look;
    look.model = model;
    look.light.direction = glm::normalize(direction);
    look.light.radiance = {1.0f, 0.9f, 0.7f};
    return look;
}

inline SweepSetting smallSetting(bool single = true) {
    SweepSetting setting;
    setting.slices = 16;
    setting.lightSize = 20;
    setting.singleTarget = single;
    return setting;
}

struct Difference {
    double worst = 0, mean = 0, brightest = 0;
    int depths = 0;  // pixels whose view depths disagree
};

inline Difference differenceOf(const MediumPicture& a, const MediumPicture& b) {
    Difference d;
    for (int y = 0; y < a.light.height(); ++y)
        for (int x = 0; x < a.light.width(); ++x) {
            const glm::vec4 p = a.light.at(x, y), q = b.light.at(x, y);
            for (int c = 0; c < 4; ++c) {
                const double away = std::abs(p[c] - q[c]);
                d.worst = std::isfinite(away) ? std::max(d.worst, away) : 1e9;
                d.mean += away / (4.0 * a.light.width() * a.light.height());
                if (c < 3) d.brightest = std::max<double>(d.brightest, q[c]);
            }
            const float m = a.viewDepth.at(x, y), n = b.viewDepth.at(x, y);
            if (!(m == n || std::abs(m - n) < 1e-4f * n)) ++d.depths;
        }
    return d;
}

// A medium and what has compiled its shaders, which takes longer than to use them.
struct Subject {
    explicit Subject(Medium m) : medium(std::move(m)) {}
    Medium medium;
    MediumGpu gpu{medium};
};

class MediumGpuTest : public testing::Test {
protected:
    void SetUp() override {
        if (!mContext.current() || epoxy_gl_version() < 45)
            GTEST_SKIP() << "no OpenGL 4.5 through EGL's surfaceless platform here";
    }

    static constexpr double kRounding = 2e-5;

    // Forward sweeps go on up to 16 slabs behind where a ray has less than 1/1024 left: that is the most that
    // they differ by, beside the rounding of floats.
    static void expectAsByTheBook(Subject& subject, const MediumLook& look, const std::vector<EyeView>& eyes,
                                  const SweepSetting& setting, double time = 0) {
        const glm::dvec3 head = eyes[0].head;
        std::vector<MediumPicture> got(eyes.size());
        subject.gpu.render(look, setting, eyes, head, time, got);
        const Medium& medium = subject.medium;
        const SweepGeometry geometry = makeSweepGeometry(medium, look, setting, eyes, head);
        const std::vector<MediumPicture> expected = plainSweep(medium, look, setting, geometry, time);
        for (std::size_t n = 0; n < eyes.size(); ++n) {
            ASSERT_EQ(got[n].light.width(), expected[n].light.width());
            const Difference d = differenceOf(got[n], expected[n]);
            EXPECT_GT(d.brightest, 0.02) << "nothing to compare";
            EXPECT_LE(d.worst, geometry.forward ? 1.0 / 1024 + kRounding : kRounding);
            EXPECT_LE(d.mean, geometry.forward ? 1e-4 : kRounding / 4);
            EXPECT_LE(d.depths, 2);
        }
    }

    EglContext mContext;
};

inline const glm::dvec3 kEye = kMiddle + glm::dvec3(0.4, -2.0, 0.5);
inline const glm::dvec3 kWithView{0.2, 1, -0.4}, kAgainstView{0.3, -1, -0.5}, kBeside{1, 0.1, -0.1};

inline Perturbation twoScales() {
    Perturbation noise;
    noise.scales.resize(2);
    noise.scales[0] = {1.2, 0.06, 0.5f, {0.2f, -0.3f, 0.1f}, {0.3f, 0.2f, -0.4f}, {0.1, 0, -0.2}};
    noise.scales[1] = {0.5, 0.03, -0.7f, {-0.1f, 0.2f, 0.1f}, {0.1f, 0.1f, 0.1f}, {0, 0.3, 0}};
    return noise;
}

}  // namespace stereonav::gpu_test
