// Where the viewer sweeps media: the graphics card's pictures are the processor's, what it can not do is told
// once and done on the processor, and the faster of the two is taken. Runs without a display.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "app/view/sweep.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/display/medium_gpu.h"
#include "tests/display/egl_context.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

TEST(ViewSweepOption, SoftwareIsKnownByItsName) {
    for (const char* name : {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Software Rasterizer",
                             "Google SwiftShader", "Mesa DRI swrast"})
        EXPECT_TRUE(drawsInSoftware(name)) << name;
    for (const char* name : {"", "NVIDIA H200/PCIe/SSE2", "AMD Radeon RX 6600 (navi23, LLVM 15.0.6)",
                             "Mesa Intel(R) UHD Graphics 620 (KBL GT2)"})
        EXPECT_FALSE(drawsInSoftware(name)) << name;
}

// A ball of `size` voxels, a metre along x; values 0 to 1000.
std::shared_ptr<GreyVolume> ball(const glm::ivec3& size) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = glm::dvec3(1.0 / size.x);
    frame.origin = -0.5 * frame.spacing * glm::dvec3(size - 1);
    auto field = std::make_shared<GreyVolume>(frame);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const glm::dvec3 place = frame.origin + frame.spacing * glm::dvec3(i, j, k);
                const double r2 = glm::dot(place, place);
                field->at(i, j, k) = static_cast<std::int16_t>(1000 * std::exp(-10 * r2));
            }
    return field;
}

MediumScene sceneOf(const glm::ivec3& size) {
    std::vector<MediumPoint> points(2);
    points[0].value = 200;
    points[1].value = 900;
    points[1].material = {{0.9f, 0.6f, 0.3f}, 0.6, {0.9f, 0.7f, 0.5f}, 0.2, {}};
    const MediumTransfer transfer(points, 0.2, "test");
    const std::shared_ptr<const GreyVolume> field = ball(size);
    MediumScene scene;
    scene.medium = Medium(field, transfer);
    scene.makeSurface = [field, transfer] { return Medium(field, allSurface(transfer)); };
    scene.turnLight(1.0, 0.6);
    scene.sweep.slices = 16;
    scene.sweep.lightSize = 20;
    return scene;
}

StereoViews views() {
    Lens lens;
    lens.width = 24;
    lens.height = 20;
    lens.verticalFov = 0.8;
    lens.nearDepth = 0.01;
    return makeStereoViews(poseFromAngles({0.1, -1.8, 0.2}, 0, 0, 0), lens, {0.1, 1.8});
}

class ViewSweepTest : public testing::Test {
protected:
    void SetUp() override {
        if (!mContext.current() || epoxy_gl_version() < 45)
            GTEST_SKIP() << "no OpenGL 4.5 through EGL's surfaceless platform here";
    }
    SweepChooser chooser(SweepChoice choice) {
        return gpuSweep(nullptr, choice, [this](const std::string& notice) { mTold.push_back(notice); });
    }

    EglContext mContext;
    std::vector<std::string> mTold;
    EyePair mFrame;
};

// The bound of medium_gpu_test.cpp: rays end where less than this is left of them.
constexpr double kEnd = 1.0 / 1024, kRounding = 2e-5;

double worst(const MediumPicture& a, const MediumPicture& b) {
    double worst = 0;
    for (int y = 0; y < a.light.height(); ++y)
        for (int x = 0; x < a.light.width(); ++x)
            for (int c = 0; c < 4; ++c) {
                const double away = std::abs(a.light.at(x, y)[c] - b.light.at(x, y)[c]);
                worst = std::isfinite(away) ? std::max(worst, away) : 1e9;
            }
    return worst;
}

// Sweeps on both and compares.
class Both {
public:
    explicit Both(SweepChooser gpu) : mGpu(std::move(gpu)) {}
    bool operator()(const SweepTask& task, const std::function<void()>& cpu) {
        const auto noCpu = [] { ADD_FAILURE() << "the processor swept"; };
        EXPECT_TRUE(mGpu(task, noCpu));
        const std::vector<MediumPicture> got(task.pictures.begin(), task.pictures.end());
        cpu();
        for (std::size_t n = 0; n < got.size(); ++n) {
            EXPECT_EQ(got[n].light.width(), task.pictures[n].light.width());
            EXPECT_LE(worst(got[n], task.pictures[n]), kEnd + kRounding);
            float brightest = 0;
            for (int y = 0; y < got[n].light.height(); ++y)
                for (int x = 0; x < got[n].light.width(); ++x)
                    brightest = std::max(brightest, got[n].light.at(x, y).x);
            EXPECT_GT(brightest, 0.02f) << "nothing to compare";
            ++pictures;
        }
        return true;
    }
    int pictures = 0;

private:
    SweepChooser mGpu;
};

TEST_F(ViewSweepTest, PicturesAreThoseOfTheProcessor) {
    MediumScene scene = sceneOf({16, 15, 14});
    SweptFrames renderer(scene);
    const auto both = std::make_shared<Both>(chooser(SweepChoice::Gpu));
    renderer.setSweep(
        [both](const SweepTask& task, const std::function<void()>& cpu) { return (*both)(task, cpu); });
    for (const MediumModel model :
         {MediumModel::Emission, MediumModel::Surface, MediumModel::Direct, MediumModel::Indirect}) {
        SCOPED_TRACE(nameOf(model));
        scene.look.model = model;
        both->pictures = 0;
        renderer.make(views(), 0, {kSweepMethod, {}}, mFrame);
        renderer.make(views(), 0, {kTwoSweepsMethod, {}}, mFrame);
        renderer.makeOne(views().left, 0, mFrame);
        EXPECT_EQ(both->pictures, 5);
        EXPECT_TRUE(renderer.sweptElsewhere());
    }
    EXPECT_THAT(mTold, testing::IsEmpty());
}

TEST_F(ViewSweepTest, TheDepthSplatStaysOnTheProcessor) {
    MediumScene scene = sceneOf({16, 15, 14});
    SweptFrames renderer(scene);
    int asked = 0;
    renderer.setSweep([&](const SweepTask&, const std::function<void()>& cpu) {
        ++asked;
        cpu();
        return true;
    });
    renderer.make(views(), 0, {kSweepMethod, {}}, mFrame);
    EXPECT_TRUE(renderer.sweptElsewhere());
    EXPECT_EQ(asked, 1);
    renderer.make(views(), 0, {kDepthSplatMethod, {}}, mFrame);
    EXPECT_FALSE(renderer.sweptElsewhere());
    EXPECT_EQ(asked, 1);
    renderer.makeOne(views().left, 0, mFrame);
    EXPECT_EQ(asked, 2);
}

TEST_F(ViewSweepTest, WhatDoesNotFitIsToldOnceAndDoneOnTheProcessor) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
    if (most > 1 << 16) GTEST_SKIP() << "volumes of any length fit here";
    const MediumScene scene = sceneOf({most + 1, 200, 2});
    SweptFrames here(scene), asked(scene);
    asked.setSweep(chooser(SweepChoice::Gpu));
    EyePair expected;
    here.make(views(), 0, {}, expected);
    for (int frame = 0; frame < 2; ++frame) {
        asked.make(views(), 0, {kSweepMethod, {}}, mFrame);
        EXPECT_FALSE(asked.sweptElsewhere());
        for (int y = 0; y < expected.left.height(); ++y)
            for (int x = 0; x < expected.left.width(); ++x) {
                ASSERT_EQ(mFrame.left.color.at(x, y), expected.left.color.at(x, y));
                ASSERT_EQ(mFrame.right.color.at(x, y), expected.right.color.at(x, y));
            }
    }
    ASSERT_EQ(mTold.size(), 1u);
    EXPECT_THAT(mTold[0], HasSubstr("volume: expected at most " + std::to_string(most)));
}

// A processor as slow as it is asked to be.
TEST_F(ViewSweepTest, TheFasterIsTaken) {
    const MediumScene scene = sceneOf({16, 15, 14});
    const std::vector<EyeView> eyes{views().left};
    std::vector<MediumPicture> pictures(1);
    const SweepTask task{scene.medium, scene.look, scene.sweep, eyes, eyes[0].head, 0, pictures};
    for (const bool isSlow : {true, false}) {
        SCOPED_TRACE(isSlow);
        const SweepChooser choice = chooser(SweepChoice::Auto);
        int swept = 0;
        const Stopwatch watch;
        const auto cpu = [&] {  // at once, or longer than all that was swept so far
            ++swept;
            if (isSlow)
                std::this_thread::sleep_for(2 *
                                            std::chrono::duration<double, std::milli>(watch.elapsed_ms()));
        };
        EXPECT_EQ(choice(task, cpu), isSlow);
        const int first = swept;
        EXPECT_GE(first, 1);
        EXPECT_EQ(choice(task, cpu), isSlow);
        EXPECT_EQ(swept, isSlow ? first : first + 1) << "it is chosen once";
    }
    EXPECT_THAT(mTold, testing::IsEmpty());
}

}  // namespace
}  // namespace stereonav
