// The late warp's shader against its kernels and its plain form, and what is drawn of its eyes. Runs without
// a display, on whatever draws OpenGL here.
#include "engine/display/late_warp_gpu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "engine/camera/stereo_rig.h"
#include "engine/display/stereo_presenter.h"
#include "engine/late/late_guard.h"
#include "tests/display/egl_context.h"
#include "tests/oracle/late_oracle.h"

namespace stereonav {
namespace {

constexpr int kLateAcross = 240, kLateDown = 150;

Lens lateLens() {
    Lens lens;
    lens.width = kLateAcross;
    lens.height = kLateDown;
    lens.verticalFov = 0.8;
    return lens;
}

StereoViews lateEyes(const glm::dvec3& place, double heading, double pitch, const Lens& lens = lateLens()) {
    return makeStereoViews(poseFromAngles(place, heading, pitch, 0), lens, {0.1, 6});
}

// Ground at height 0 with three pillars on it, round ones, under a sky; smooth colours.
EyeImage castPillars(const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 d = view.rayDirection(x + 0.5, y + 0.5);
            double depth = d.z < 0 ? -view.eye.z / d.z : std::numeric_limits<double>::infinity();
            bool pillar = false;
            for (const glm::dvec2& foot : {glm::dvec2(-1, 6), glm::dvec2(0.8, 9), glm::dvec2(2, 5)}) {
                const glm::dvec2 away = glm::dvec2(view.eye) - foot, along(d);
                const double a = glm::dot(along, along), b = glm::dot(along, away),
                             c = glm::dot(away, away) - 0.16, root = b * b - a * c;
                const double t = root < 0 ? 0 : (-b - std::sqrt(root)) / a;
                if (t > 0 && t < depth) depth = t, pillar = true;
            }
            const glm::dvec3 at = view.eye + (std::isfinite(depth) ? depth : 0.0) * d;
            const auto wave = [](double value) { return static_cast<float>(0.5 + 0.3 * std::sin(value)); };
            image.viewDepth.at(x, y) = static_cast<float>(depth);
            image.color.at(x, y) = !std::isfinite(depth) ? packColor({0.3f, 0.5f, 0.9f})
                                   : pillar              ? packColor({0.9f, wave(2 * at.z), 0.2f})
                                            : packColor({0.2f, wave(0.6 * at.x), wave(0.5 * at.y)});
        }
    return image;
}

struct LateApart {
    double psnr_db = 0, wrong = 0, marks = 0;  // shares of pixels: more than 16 of 1023 apart; marked by one
};

LateApart lateApart(const Plane<PackedColor>& a, const Plane<PackedColor>& b,
                    const Plane<std::uint8_t>& markedA, const Plane<std::uint8_t>& markedB) {
    double squares = 0, wrong = 0, marks = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            int most = 0;
            for (int k = 0; k < 30; k += 10) {
                const int apart =
                    static_cast<int>(a.at(x, y) >> k & 1023u) - static_cast<int>(b.at(x, y) >> k & 1023u);
                squares += apart * apart;
                most = std::max(most, std::abs(apart));
            }
            wrong += most > 16;
            marks += markedA.at(x, y) != markedB.at(x, y);
        }
    const double pixels = static_cast<double>(a.width()) * a.height();
    return {10 * std::log10(1023.0 * 1023.0 * 3 * pixels / std::max(squares, 1e-9)), wrong / pixels,
            marks / pixels};
}

struct LateShaderMotion {
    const char* name;
    glm::dvec3 move;
    double turn, pitch;  // radians
};
const LateShaderMotion kShaderMotions[] = {
    {"none", {0, 0, 0}, 0, 0},    {"turns", {0, 0, 0}, 0.04, 0.02}, {"ahead", {0, 0.3, 0}, 0, 0},
    {"aside", {0.2, 0, 0}, 0, 0}, {"back", {0, -0.3, 0.1}, 0, 0},   {"all", {0.1, 0.2, 0.1}, -0.03, 0}};

class LateWarpGpuTest : public testing::Test {
protected:
    void SetUp() override {
        if (!mContext.current()) GTEST_SKIP() << "no OpenGL 3.3 through EGL's surfaceless platform here";
    }
    EglContext mContext;
};

// Both eyes, in full size and out of a smaller picture that was cast with a guard around it. Where depths are
// smooth rows of the kernels hand theirs on, and a pixel at an edge may go to either side of it: one in two
// hundred differs. From the plain form, which takes quarters of a pixel's steps, it is as far as they are.
TEST_F(LateWarpGpuTest, IsAsTheKernelsAndThePlainForm) {
    LateWarpGpu gpu;
    ASSERT_TRUE(gpu.works());
    for (const bool small : {false, true}) {
        Lens lens = lateLens();
        if (small) {
            lens.width = 160;
            lens.height = 100;
            lens = guarded(lens, {14, 9});
        }
        const StereoViews from = lateEyes({0, 0, 1.7}, 0, -0.1, lens);
        for (std::size_t eye = 0; eye < 2; ++eye) {
            const EyeView& view = eye == 0 ? from.left : from.right;
            const EyeImage seen = castPillars(view);
            LateEye late;
            late.prepare(seen.viewDepth, view);
            gpu.take(eye, late, seen.color);
            for (const LateShaderMotion& motion : kShaderMotions) {
                SCOPED_TRACE(std::string(motion.name) + (small ? " small " : " ") + std::to_string(eye));
                const StereoViews there =
                    lateEyes(glm::dvec3(0, 0, 1.7) + motion.move, motion.turn, -0.1 + motion.pitch);
                const EyeView& to = eye == 0 ? there.left : there.right;
                Plane<PackedColor> drawn, kernels, plain;
                Plane<std::uint8_t> drawnMarks, kernelMarks, plainMarks;
                gpu.warp(eye, late, to);
                gpu.read(eye, drawn, &drawnMarks);
                ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
                ASSERT_EQ(drawn.width(), kLateAcross);
                late.warp(seen.color, to, kernels, &kernelMarks);
                const LateApart against = lateApart(drawn, kernels, drawnMarks, kernelMarks);
                EXPECT_GT(against.psnr_db, 42);
                EXPECT_LT(against.wrong, 0.005);
                EXPECT_LT(against.marks, 0.005);
                warpLatePlainly(seen.color, seen.viewDepth, view, to, plain, plainMarks);
                const LateApart oracle = lateApart(drawn, plain, drawnMarks, plainMarks),
                                ofKernels = lateApart(kernels, plain, kernelMarks, plainMarks);
                EXPECT_GT(oracle.psnr_db, std::min(60.0, ofKernels.psnr_db) - 0.5);
                EXPECT_LT(oracle.wrong, std::min(0.02, ofKernels.wrong + 0.003));
                EXPECT_LT(oracle.marks, std::min(0.02, ofKernels.marks + 0.003));
            }
        }
    }
}

// Whatever comes is a picture: nothing known, all sky, a view behind, one pixel.
TEST_F(LateWarpGpuTest, TakesAnything) {
    LateWarpGpu gpu;
    const EyeView view = lateEyes({0, 0, 1.7}, 0, -0.1).left;
    EyeImage seen = castPillars(view);
    for (const float depth : {0.0f, std::numeric_limits<float>::infinity(), std::nanf("")}) {
        for (int y = 20; y < 60; ++y)
            for (int x = 0; x < kLateAcross; ++x) seen.viewDepth.at(x, y) = depth;
        LateEye late;
        late.prepare(seen.viewDepth, view);
        gpu.take(0, late, seen.color);
        Lens one = lateLens();
        one.width = one.height = 1;
        for (const EyeView& to : {lateEyes({0, 0, 1.7}, 3.1, 0).left, lateEyes({0, 0, 1.7}, 0, 0, one).left,
                                  lateEyes({0, 5, 1.7}, 0, 0).left}) {
            gpu.warp(0, late, to);
            Plane<PackedColor> image;
            gpu.read(0, image);
            ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
            EXPECT_EQ(image.width(), to.width);
        }
    }
}

std::vector<unsigned char> drawnBy(const StereoPresenter& presenter, const ComposeSetting& setting, int width,
                                   int height) {
    GlTexture texture;
    GlFramebuffer framebuffer;
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    glClear(GL_COLOR_BUFFER_BIT);
    presenter.draw(setting, {0, 0, width, height});
    std::vector<unsigned char> pixels(static_cast<std::size_t>(width) * height * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return pixels;
}

// Eyes that stay on the graphics processor are shown in each mode as the same pictures are from memory.
TEST_F(LateWarpGpuTest, ItsEyesAreShownInEachMode) {
    LateWarpGpu gpu;
    const StereoViews from = lateEyes({0, 0, 1.7}, 0, -0.1), there = lateEyes({0.1, 0.2, 1.7}, 0.03, -0.1);
    std::array<GLuint, 2> drawn{};
    std::array<std::shared_ptr<Plane<PackedColor>>, 2> read;
    for (std::size_t eye = 0; eye < 2; ++eye) {
        const EyeView& view = eye == 0 ? from.left : from.right;
        const EyeImage seen = castPillars(view);
        LateEye late;
        late.prepare(seen.viewDepth, view);
        gpu.take(eye, late, seen.color);
        drawn[eye] = gpu.warp(eye, late, eye == 0 ? there.left : there.right);
        read[eye] = std::make_shared<Plane<PackedColor>>();
        gpu.read(eye, *read[eye]);
    }
    StereoPresenter textures, pictures;
    textures.showTextures(drawn[0], drawn[1], kLateAcross, kLateDown);
    pictures.show(read[0], read[1]);
    for (const OutputModeInfo& mode : outputModes())
        for (const bool swap : {false, true}) {
            const ComposeSetting setting{mode.mode, swap, false};
            const auto [width, height] = composedSize(mode.mode, kLateAcross, kLateDown);
            const auto a = drawnBy(textures, setting, width, height),
                       b = drawnBy(pictures, setting, width, height);
            ASSERT_EQ(a.size(), b.size());
            int most = 0;
            for (std::size_t n = 0; n < a.size(); ++n) most = std::max(most, std::abs(a[n] - b[n]));
            EXPECT_LE(most, 1) << mode.shortName;
            EXPECT_NE(*std::max_element(a.begin(), a.end() - 1), 0);
        }
    // And pictures from memory after that.
    textures.show(read[1], read[0]);
    pictures.show(read[1], read[0]);
    const ComposeSetting beside{OutputMode::SideBySide, false, false};
    EXPECT_EQ(drawnBy(textures, beside, 2 * kLateAcross, kLateDown),
              drawnBy(pictures, beside, 2 * kLateAcross, kLateDown));
}

}  // namespace
}  // namespace stereonav
