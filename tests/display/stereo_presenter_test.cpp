// What the fragment shader draws equals what the CPU composes, in every mode. Runs without a display.
#include "engine/display/stereo_presenter.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <vector>

#include "engine/base/error.h"
#include "engine/display/eye_passes.h"
#include "engine/display/window.h"
#include "tests/display/egl_context.h"

namespace stereonav {
namespace {

using Picture = Plane<PackedColor>;
using Bytes = std::array<int, 3>;

Picture noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Picture p(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) p.at(x, y) = random() & 0x3fffffffu;
    return p;
}

Bytes bytesOf(PackedColor c) {
    const auto& t = srgbByteFromPacked();
    return {t[c & 1023], t[c >> 10 & 1023], t[c >> 20 & 1023]};
}

// An 8-bit framebuffer to draw into; rows come back from the top.
class Target {
public:
    Target(int width, int height) : mWidth(width), mHeight(height) {
        glBindTexture(GL_TEXTURE_2D, mTexture.name());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        glBindFramebuffer(GL_FRAMEBUFFER, mFramebuffer.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, mTexture.name(), 0);
        EXPECT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    void read() {
        mPixels.resize(static_cast<std::size_t>(mWidth) * mHeight * 4);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, mWidth, mHeight, GL_RGBA, GL_UNSIGNED_BYTE, mPixels.data());
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
    Bytes at(int x, int y) const {
        const unsigned char* p = &mPixels[(static_cast<std::size_t>(mHeight - 1 - y) * mWidth + x) * 4];
        return {p[0], p[1], p[2]};
    }

private:
    int mWidth, mHeight;
    GlTexture mTexture;
    GlFramebuffer mFramebuffer;
    std::vector<unsigned char> mPixels;
};

int largestDifference(const Bytes& a, const Bytes& b) {
    int largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
    return largest;
}

class StereoPresenterTest : public testing::Test {
protected:
    void SetUp() override {
        if (!mContext.current()) GTEST_SKIP() << "no OpenGL 3.3 through EGL's surfaceless platform here";
    }
    EglContext mContext;
};

void expectEqualToComposed(const Picture& left, const Picture& right, const ComposeSetting& setting) {
    StereoPresenter presenter;
    presenter.upload(left, right);
    const Picture expected = composeStereo(left, right, setting);
    Target target(expected.width(), expected.height());
    presenter.draw(setting, {0, 0, expected.width(), expected.height()});
    target.read();
    int worst = 0;
    for (int y = 0; y < expected.height(); ++y)
        for (int x = 0; x < expected.width(); ++x)
            worst = std::max(worst, largestDifference(target.at(x, y), bytesOf(expected.at(x, y))));
    const OutputModeInfo& info = infoOf(setting.mode);
    constexpr OutputLayout kComposed[] = {OutputLayout::Rows, OutputLayout::Columns,
                                          OutputLayout::Checkerboard, OutputLayout::Anaglyph};
    const bool whole = !info.half && std::ranges::find(kComposed, info.layout) == std::end(kComposed);
    EXPECT_LE(worst, whole ? 0 : 1) << infoOf(setting.mode).longName << (setting.swapEyes ? " swapped" : "")
                                    << (setting.linearAnaglyph ? " linear" : "");
}

TEST_F(StereoPresenterTest, EveryModeEqualsTheCpu) {
    // Odd sizes, so that squeezed modes meet a last pixel alone; high enough for a gap of rows.
    const Picture left = noise(37, 51, 1), right = noise(37, 51, 2);
    for (const OutputModeInfo& info : outputModes())
        for (const bool swapped : {false, true})
            for (const bool linear : {false, true})
                for (const int turn : {0, 1})
                    for (const EyePass& pass : eyePasses({info.mode, swapped, linear}, turn, true))
                        if (turn == 0 || !fitsInPicture(info.mode))
                            expectEqualToComposed(left, right, pass.setting);
}

TEST_F(StereoPresenterTest, OneEyeStandsForBoth) {
    const Picture eye = noise(16, 8, 3);
    StereoPresenter presenter;
    EXPECT_FALSE(presenter.hasPicture());
    presenter.upload(eye, Picture());
    ASSERT_TRUE(presenter.hasPicture());
    Target target(32, 8);
    presenter.draw({OutputMode::SideBySide, false, false}, {0, 0, 32, 8});
    target.read();
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 32; ++x)
            ASSERT_LE(largestDifference(target.at(x, y), bytesOf(eye.at(x % 16, y))), 1);
}

TEST_F(StereoPresenterTest, ViewportAndItsPlaceOnTheScreenAreKept) {
    const Picture left = noise(8, 6, 4), right = noise(8, 6, 5);
    StereoPresenter presenter;
    presenter.upload(left, right);
    Target target(20, 16);
    presenter.draw({OutputMode::Rows, false, false}, {3, 5, 8, 6}, 0, 1);
    target.read();
    const int top = 16 - 5 - 6;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 20; ++x) {
            const bool inside = x >= 3 && x < 11 && y >= top && y < top + 6;
            Bytes expected{0, 0, 0};
            // The window begins on an odd row of the screen: its first row is the second eye's.
            if (inside) expected = bytesOf(((y - top) % 2 ? left : right).at(x - 3, y - top));
            ASSERT_LE(largestDifference(target.at(x, y), expected), 1) << x << ' ' << y;
        }
}

TEST_F(StereoPresenterTest, OddWindowsLeaveTheirLastColumnOrRowBlack) {
    const Picture left = noise(5, 4, 8), right = noise(5, 4, 9);
    StereoPresenter presenter;
    presenter.upload(left, right);
    Target target(11, 4);
    presenter.draw({OutputMode::SideBySide, false, false}, {0, 0, 11, 4});
    target.read();
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 11; ++x) {
            const Bytes expected = x < 10 ? bytesOf((x < 5 ? left : right).at(x % 5, y)) : Bytes{0, 0, 0};
            ASSERT_LE(largestDifference(target.at(x, y), expected), 1) << x << ' ' << y;
        }
    Target tall(5, 9);
    presenter.draw({OutputMode::TopBottom, false, false}, {0, 0, 5, 9});
    tall.read();
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 5; ++x) {
            const Bytes expected = y < 8 ? bytesOf((y < 4 ? left : right).at(x, y % 4)) : Bytes{0, 0, 0};
            ASSERT_LE(largestDifference(tall.at(x, y), expected), 1) << x << ' ' << y;
        }
}

TEST_F(StereoPresenterTest, PicturesOfAnotherSizeAreScaledToTheNearestPixel) {
    const Picture left = noise(5, 4, 6), right = noise(5, 4, 7);
    StereoPresenter presenter;
    presenter.upload(left, right);
    Target target(15, 12);
    presenter.draw({OutputMode::Left, false, false}, {0, 0, 15, 12});
    target.read();
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 15; ++x)
            ASSERT_LE(largestDifference(target.at(x, y), bytesOf(left.at(x / 3, y / 3))), 1);
    presenter.upload(right, left);
    presenter.draw({OutputMode::Left, false, false}, {0, 0, 15, 12});
    target.read();
    EXPECT_LE(largestDifference(target.at(14, 11), bytesOf(right.at(4, 3))), 1) << "uploads replace";
}

TEST_F(StereoPresenterTest, UnequalEyesAreRefused) {
    StereoPresenter presenter;
    EXPECT_THROW(presenter.upload(noise(4, 4, 1), noise(4, 5, 1)), Error);
    EXPECT_THROW(presenter.upload(Picture(), Picture()), Error);
}

TEST_F(StereoPresenterTest, UnknownShadersAreNamed) {
    try {
        const ShaderProgram program("nothing.vert", "stereo_present.frag");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("nothing.vert"));
    }
}

TEST(HasDisplay, IsFalseWithoutOneAndTheWindowSaysSo) {
    // Runs in its own process (gtest_discover_tests), so the environment is its own.
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    EXPECT_FALSE(hasDisplay());
    try {
        const Window window("test", 320, 200);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("DISPLAY"));
        EXPECT_THAT(error.what(), testing::HasSubstr("render"));
    }
}

TEST(HasDisplay, IsFalseForADisplayThatIsNotThere) {
    unsetenv("WAYLAND_DISPLAY");
    setenv("DISPLAY", ":7654", 1);
    EXPECT_FALSE(hasDisplay());
    EXPECT_THROW(Window("test", 320, 200), Error);
}

}  // namespace
}  // namespace stereonav
