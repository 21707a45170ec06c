// The sweep in GLSL at its extremes, as rows of the stability table: optical depths from a millionth to a
// million, pictures of one pixel, one row and one column, eyes in one place and far apart, against the plain
// model.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "engine/display/medium_gpu.h"
#include "tests/display/egl_context.h"
#include "tests/medium/sweep_scenes.h"
#include "tests/oracle/plain_sweep.h"
#include "tests/support/stability_row.h"

namespace stereonav {
namespace {

using namespace test;

// The bound of medium_gpu_test.cpp: forward sweeps stop where less than 1/1024 is left; the rest is rounding
// of floats.
constexpr double kBound = 1.0 / 1024 + 2e-5;

struct GpuCase {
    std::string id, words;
    double opticalDepth = 1;  // depth of a decimetre
    int width = 12, height = 9;
    double apart = 0.06;  // metres, of the eyes
    double distance = 3;  // metres of the head from the middle
};

class GpuSweepRow : public testing::TestWithParam<GpuCase> {
protected:
    void SetUp() override {
        if (!mContext.current() || epoxy_gl_version() < 45)
            GTEST_SKIP() << "no OpenGL 4.5 through EGL's surfaceless platform here";
    }
    EglContext mContext;
};

Medium cloud(double opticalDepth) {
    auto field = makeField({9, 8, 7}, 2.0, glm::dvec3(0), [](const glm::ivec3& v) {
        return 400 + 400 * std::sin(0.9 * v.x) * std::sin(0.7 * v.y + 1) * std::sin(0.8 * v.z + 2);
    });
    MediumMaterial clear, dense;
    clear.opacity = 0;
    dense.opacity = -std::expm1(-opticalDepth);
    dense.color = {0.9f, 0.7f, 0.5f};
    return Medium(field, MediumTransfer({{300, clear}, {700, dense}}, 0.1, "test"));
}

TEST_P(GpuSweepRow, IsAsByTheBook) {
    const GpuCase& given = GetParam();
    StabilityRow row("gpu/" + given.id, "a cloud swept in GLSL, " + given.words,
                     "difference of light, of a light of 1", kBound, "");
    const Medium medium = cloud(given.opticalDepth);
    MediumGpu gpu(medium);
    SweepSetting setting;
    setting.slices = 12;
    setting.lightSize = 16;
    const glm::dvec3 head = given.distance * glm::normalize(glm::dvec3(0.1, -1, 0.3));
    for (const glm::dvec3 way :
         {glm::dvec3(0.3, 0.8, -0.4), glm::dvec3(0.3, -0.8, -0.4)}) {  // with and against
        MediumLook look;
        look.light = sun(way);
        std::vector<EyeView> eyes;
        for (const double side : {-0.5, 0.5}) {
            eyes.push_back(viewFrom(head + glm::dvec3(side * given.apart, 0, 0), {0, 0, 0}, 0.5, given.width,
                                    given.height));
            const double half = 0.3 * std::min(1.0, 3 / given.distance);  // the cloud fills the picture
            eyes.back().xMin = eyes.back().yMin = -half, eyes.back().xMax = eyes.back().yMax = half;
        }
        const SweepGeometry geometry = makeSweepGeometry(medium, look, setting, eyes, head);
        const std::vector<MediumPicture> truth = plainSweep(medium, look, setting, geometry);
        std::vector<MediumPicture> got(2);
        float thickest = 0;
        gpu.render(look, setting, eyes, head, 0, got);
        for (std::size_t e = 0; e < 2; ++e)
            for (int y = 0; y < given.height; ++y)
                for (int x = 0; x < given.width; ++x) {
                    const glm::dvec4 a(got[e].light.at(x, y)), b(truth[e].light.at(x, y));
                    for (int c = 0; c < 4; ++c) row.saw(std::abs(a[c] - b[c]));
                    thickest = std::max(thickest, 1 - truth[e].light.at(x, y).w);
                }
        EXPECT_GT(thickest, 0.1 * std::min(1.0, given.opticalDepth)) << "nothing to compare";
    }
}

std::vector<GpuCase> cases() {
    std::vector<GpuCase> all;
    for (const double depth : {1e-6, 1e-3, 1.0, 1e3, 1e6})
        all.push_back({"optical-depth/" + test::shortNumber(depth),
                       "optical depth " + test::shortNumber(depth) + " a decimetre", depth});
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 33}, {33, 1}}) {
        const std::string size = std::to_string(width) + "x" + std::to_string(height);
        all.push_back({"image/" + size, size + " pixels", 1, width, height});
    }
    for (const double apart : {0.0, 1e-6, 3.0})
        all.push_back({"separation/" + test::shortNumber(apart),
                       "eyes " + test::shortNumber(apart) + " m apart", 1, 12, 9, apart});
    for (const double distance : {0.01, 300.0})
        all.push_back({"distance/" + test::shortNumber(distance),
                       "seen from " + test::shortNumber(distance) + " m from its middle", 1, 12, 9, 1e-3,
                       distance});
    return all;
}

INSTANTIATE_TEST_SUITE_P(Stability, GpuSweepRow, testing::ValuesIn(cases()),
                         [](const auto& given) { return testName(given.param.id); });

}  // namespace
}  // namespace stereonav
