// Windows on real servers: full screen and back, rows counted from the monitor, eyes by turns, and no quad
// buffer. Those of two monitors run in a process of their own, on a server that two_monitors.sh starts.
#define GLFW_INCLUDE_NONE
#include <dlfcn.h>
#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <sstream>

#include "app/view/view_display.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/display/stereo_presenter.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

constexpr const char* kTwoMonitors = "STEREONAV_TWO_MONITORS";        // set in that process
constexpr PackedColor kLeftColor = 1023u, kRightColor = 1023u << 20;  // left, right eye
constexpr int kSecondX = 1025, kSecondY = 33;                         // corner of the second monitor

Plane<PackedColor> filledEye(PackedColor color, int width, int height) {
    Plane<PackedColor> eye(width, height);
    for (int y = 0; y < height; ++y) std::fill_n(eye.row(y), width, color);
    return eye;
}

// What the X server has in a window, as GLFW's own connection is told. By hand, since no header of X is
// needed for anything else.
class ServerPixels {
public:
    unsigned long at(GLFWwindow* window, int x, int y) const {
        void* const image =
            mGetImage(mDisplay(), mWindow(window), x, y, 1, 1, ~0UL, 2);  // all planes, as pixels
        const unsigned long pixel = mGetPixel(image, 0, 0);
        mDestroyImage(image);
        return pixel;
    }
    static bool there() {
        return dlsym(RTLD_DEFAULT, "glfwGetX11Display") && dlsym(RTLD_DEFAULT, "XGetImage");
    }

private:
    template <typename F>
    static F* named(const char* name) {
        return reinterpret_cast<F*>(dlsym(RTLD_DEFAULT, name));
    }
    using GetImage = void*(void*, unsigned long, int, int, unsigned, unsigned, unsigned long, int);
    void* (*mDisplay)() = named<void*()>("glfwGetX11Display");
    unsigned long (*mWindow)(GLFWwindow*) = named<unsigned long(GLFWwindow*)>("glfwGetX11Window");
    GetImage* mGetImage = named<GetImage>("XGetImage");
    unsigned long (*mGetPixel)(void*, int, int) = named<unsigned long(void*, int, int)>("XGetPixel");
    int (*mDestroyImage)(void*) = named<int(void*)>("XDestroyImage");
};

// A visible window, where there is a display.
class OnMonitors : public testing::Test {
protected:
    void SetUp() override { open(false); }
    void open(bool quadBuffer) {
        mWindow.reset();
        try {
            mWindow = std::make_unique<Window>("test", 320, 200, true, quadBuffer);
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
    // Handles events until that is so; servers and window managers take their time.
    bool becomes(const std::function<bool()>& so) {
        return test::waitFor([&] {
            mWindow->handleEvents(0.02);
            return so();
        });
    }
    bool moves(const ScreenRect& to) {
        return becomes([&] { return mWindow->place() == to; });
    }
    // 0: the left eye's colour, 1: the right one's, -1: neither. Of what is drawn and not yet shown; from the
    // top.
    int drawnAt(int x, int y) const {
        std::array<unsigned char, 4> pixel{};
        glReadPixels(x, mWindow->framebufferSize().y - 1 - y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
        return eyeOfColor(pixel[0], pixel[2]);
    }
    // Returns the same for what the X server shows.
    int shownAt(int x, int y) const {
        const unsigned long pixel = ServerPixels().at(mWindow->handle(), x, y);
        return eyeOfColor(pixel >> 16 & 255, pixel & 255);
    }
    static int eyeOfColor(unsigned long red, unsigned long blue) {
        if ((red > 200) == (blue > 200)) return -1;
        return blue > 200 ? 1 : 0;
    }
    void fill(StereoPresenter& presenter, const ComposeSetting& setting) const {
        const glm::ivec2 size = mWindow->framebufferSize(), origin = mWindow->framebufferOrigin();
        presenter.draw(setting, {0, 0, size.x, size.y}, origin.x, origin.y);
    }

    std::unique_ptr<Window> mWindow;
};

TEST_F(OnMonitors, FullScreenCoversTheMonitorAndGoesBack) {
    const std::vector<Monitor> all = monitors();
    if (all.empty()) GTEST_SKIP() << "the display has no monitor";
    ASSERT_TRUE(becomes([&] { return mWindow->place().width == 320; }));
    const ScreenRect before = mWindow->place();
    EXPECT_FALSE(mWindow->fullScreen());
    mWindow->toggleFullScreen();
    EXPECT_TRUE(mWindow->fullScreen());
    const ScreenRect area = all[*monitorUnder(all, before)].area;
    EXPECT_TRUE(moves(area)) << mWindow->place().width << "x" << mWindow->place().height;
    EXPECT_EQ(mWindow->framebufferOrigin(), glm::ivec2(0, 0));
    mWindow->toggleFullScreen();
    EXPECT_FALSE(mWindow->fullScreen());
    EXPECT_TRUE(moves(before)) << mWindow->place().x << "," << mWindow->place().y;
    mWindow->leaveFullScreen();
    EXPECT_TRUE(moves(before)) << "nothing to leave";
    EXPECT_THROW(mWindow->enterFullScreen(all.size()), Error);
    EXPECT_FALSE(mWindow->fullScreen());
}

TEST_F(OnMonitors, TheOptionFillsTheMonitor) {
    const std::vector<Monitor> all = monitors();
    if (all.empty()) GTEST_SKIP() << "the display has no monitor";
    ViewOptions options;
    options.fullScreen = "auto";
    ViewDisplay display(*mWindow, options);
    EXPECT_TRUE(mWindow->fullScreen());
    EXPECT_TRUE(moves(all[*monitorUnder(all, mWindow->place())].area));
    display.toggleFullScreen();
    EXPECT_FALSE(mWindow->fullScreen());
    options.fullScreen = "no such monitor";
    try {
        const ViewDisplay unknown(*mWindow, options);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("1 " + all[0].name));
    }
    EXPECT_EQ(display.takeNotice(), "");
}

// After each swap the window shows the eye that was drawn, and both get their turns.
TEST_F(OnMonitors, EyesAlternate) {
    if (!ServerPixels::there()) GTEST_SKIP() << "GLFW is not X's here";
    StereoPresenter presenter;
    presenter.upload(filledEye(kLeftColor, 8, 8), filledEye(kRightColor, 8, 8));
    ViewOptions options;
    options.mode = OutputMode::Alternating;
    ViewDisplay display(*mWindow, options);
    EXPECT_EQ(display.mode().shown(), OutputMode::Alternating);
    EXPECT_EQ(display.wait(), std::nullopt);
    for (const bool swapped : {false, true}) {
        // It takes as long as it takes: where pictures come late, one eye may have its turn several times.
        std::array<int, 2> shown{};
        int changes = 0, before = -1;
        const auto turn = [&] {
            mWindow->handleEvents(display.wait().value_or(0));
            int drawn = -1;
            display.draw({OutputMode::Alternating, swapped, false}, [&](const ComposeSetting& one) {
                EXPECT_EQ(drawn, -1) << "one eye at a time";
                drawn = (one.mode == OutputMode::Right) != one.swapEyes ? 1 : 0;
                fill(presenter, one);
            });
            const int eye = shownAt(100, 100);
            EXPECT_EQ(eye, drawn);
            if (eye != drawn) return true;
            ++shown[static_cast<std::size_t>(eye)];
            changes += before >= 0 && eye != before;
            before = eye;
            return shown[0] > 15 && shown[1] > 15 && changes > 15;
        };
        ASSERT_TRUE(test::waitFor(turn)) << shown[0] << " " << shown[1] << " " << changes;
        ASSERT_FALSE(HasFailure());
    }
    // Another mode ends it.
    display.draw({OutputMode::Left, false, false}, [&](const ComposeSetting& one) { fill(presenter, one); });
    EXPECT_EQ(shownAt(100, 100), 0);
    EXPECT_EQ(display.wait(), std::nullopt);
}

TEST_F(OnMonitors, WhereNoQuadBufferIsGrantedOneLineSaysSo) {
    open(true);
    if (!mWindow || !ServerPixels::there()) return;
    ViewOptions options;
    options.mode = OutputMode::QuadBuffer;
    ViewDisplay display(*mWindow, options);
    StereoPresenter presenter;
    presenter.upload(filledEye(kLeftColor, 8, 8), filledEye(kRightColor, 8, 8));
    if (mWindow->quadBuffered()) {
        EXPECT_EQ(display.mode().shown(), OutputMode::QuadBuffer);
        EXPECT_EQ(display.takeNotice(), "");
        return;
    }
    EXPECT_EQ(display.mode().shown(), OutputMode::SideBySide);
    const std::string line = display.takeNotice();
    EXPECT_THAT(line, testing::HasSubstr("quad: the graphics driver grants no buffer for each eye"));
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_EQ(display.takeNotice(), "") << "once";
    // Who asks all the same is shown one eye, not nothing.
    display.draw({OutputMode::QuadBuffer, false, false},
                 [&](const ComposeSetting& one) { fill(presenter, one); });
    EXPECT_EQ(shownAt(100, 100), 0);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(OnMonitors, ParallaxIsToldAsItIsOnTheScreen) {
    const std::vector<Monitor> all = monitors();
    if (all.empty()) GTEST_SKIP() << "the display has no monitor";
    ASSERT_TRUE(becomes([&] { return mWindow->place().width == 320; }));
    ViewOptions options;
    options.viewingDistance_mm = 1000;
    // The width at which the window is a metre wide.
    options.screenWidth_mm = 1000.0 * all[*monitorUnder(all, mWindow->place())].area.width / 320;
    ViewDisplay display(*mWindow, options);
    ViewFrame frame;
    frame.left.color = Plane<PackedColor>(320, 1);
    frame.nearParallax = -0.02;
    frame.farParallax = 0.05;
    EXPECT_EQ(display.wordsOf(frame).parallax, "on the screen -20.0 to +50.0 mm, -1.15 to +2.86 degrees");
    EXPECT_EQ(display.wordsOf(frame).warning, "");
    frame.farParallax = 0.07;
    EXPECT_THAT(display.wordsOf(frame).warning, testing::HasSubstr("70 mm"));
    frame.left.color = Plane<PackedColor>(160, 1);
    EXPECT_EQ(display.wordsOf(frame).warning, "") << "half as wide: full side by side, or beside panels";
    frame.request.twoEyes = false;
    EXPECT_EQ(display.wordsOf(frame).parallax, "");
    EXPECT_EQ(display.wordsOf(frame).warning, "");
}

class OnTwoMonitors : public OnMonitors {
protected:
    void SetUp() override {
        if (!std::getenv(kTwoMonitors)) GTEST_SKIP() << "part of TwoMonitors";
        OnMonitors::SetUp();
        ASSERT_EQ(monitors().size(), 2u);
    }
};

TEST_F(OnTwoMonitors, AreToldWithPlaceSizeAndRate) {
    const std::vector<Monitor> all = monitors();
    EXPECT_EQ(all[0].area, (ScreenRect{0, 0, 1025, 768}));
    EXPECT_EQ(all[1].area, (ScreenRect{kSecondX, kSecondY, 3840, 1080}));
    EXPECT_EQ(all[0].refreshRate, 60);
    EXPECT_EQ(all[1].refreshRate, 120);
    EXPECT_NE(all[0].name, all[1].name);
    for (const Monitor& monitor : all) {
        EXPECT_FALSE(monitor.name.empty());
        EXPECT_GE(monitor.width_mm, 0);
        EXPECT_GT(monitor.workArea.width, 0);
        EXPECT_GE(monitor.contentScale, 1);
    }
}

TEST_F(OnTwoMonitors, OneIsFilledAfterTheOther) {
    const std::vector<Monitor> all = monitors();
    ASSERT_TRUE(becomes([&] { return mWindow->place().width == 320; }));
    const ScreenRect before = mWindow->place();
    for (const std::size_t n : {1u, 0u, 1u}) {
        mWindow->enterFullScreen(n);
        EXPECT_TRUE(moves(all[n].area)) << n;
        EXPECT_EQ(mWindow->framebufferSize(), glm::ivec2(all[n].area.width, all[n].area.height));
    }
    mWindow->leaveFullScreen();
    EXPECT_TRUE(moves(before));
    const std::vector<Monitor> after = monitors();
    for (std::size_t n = 0; n < 2; ++n) {
        EXPECT_EQ(after[n].area, all[n].area) << "video modes stay";
        EXPECT_EQ(after[n].refreshRate, all[n].refreshRate);
    }
    // The monitor is the one that the window was moved to.
    glfwSetWindowPos(mWindow->handle(), kSecondX + 100, kSecondY + 100);
    ASSERT_TRUE(moves({kSecondX + 100, kSecondY + 100, 320, 200}));
    mWindow->toggleFullScreen();
    EXPECT_TRUE(moves(all[1].area));
}

// Pixels of the window, against the rows and columns of the monitor that it stands on.
TEST_F(OnTwoMonitors, InterleavedModesKeepToTheMonitorsRows) {
    StereoPresenter presenter;
    presenter.upload(filledEye(kLeftColor, 64, 64), filledEye(kRightColor, 64, 64));
    const std::array<glm::ivec2, 2> first{glm::ivec2(0, 0), glm::ivec2(kSecondX, kSecondY)};
    for (const glm::ivec2& monitor : first)
        for (const glm::ivec2 place : {glm::ivec2(20, 30), {21, 30}, {20, 31}, {21, 31}}) {
            const glm::ivec2 at = monitor + place;
            glfwSetWindowPos(mWindow->handle(), at.x, at.y);
            ASSERT_TRUE(moves({at.x, at.y, 320, 200})) << at.x << "," << at.y;
            bool redraws = false;  // while it is moved, too
            EXPECT_TRUE(becomes([&] { return redraws = redraws || mWindow->redrawNeeded(); }));
            for (const OutputMode mode : {OutputMode::Rows, OutputMode::Columns, OutputMode::Checkerboard}) {
                fill(presenter, {mode, false, false});
                for (int y = 0; y < 4; ++y)
                    for (int x = 0; x < 4; ++x) {
                        // From the monitor's own first pixel.
                        const glm::ivec2 pixel = place + glm::ivec2(x, y);
                        const int turn = mode == OutputMode::Rows      ? pixel.y
                                         : mode == OutputMode::Columns ? pixel.x
                                                                       : pixel.x + pixel.y;
                        EXPECT_EQ(drawnAt(x, y), turn % 2)
                            << infoOf(mode).longName << " at " << at.x << "," << at.y;
                    }
            }
        }
    mWindow->enterFullScreen(1);
    ASSERT_TRUE(moves({kSecondX, kSecondY, 3840, 1080}));
    mWindow->swapBuffers();  // buffers of the new size from here on
    fill(presenter, {OutputMode::Rows, false, false});
    for (const int y : {0, 1, 2, 1078, 1079}) EXPECT_EQ(drawnAt(5, y), y % 2);
}

class TwoMonitors : public testing::Test {
protected:
    void SetUp() override {
        if (std::getenv(kTwoMonitors)) GTEST_SKIP() << "is that process";
        mFolder =
            std::filesystem::path(testing::TempDir()) / ("stereonav_monitors_" + std::to_string(getpid()));
        std::filesystem::create_directories(mFolder);
    }
    void TearDown() override { std::filesystem::remove_all(mFolder); }
    // Runs a command on a server of two monitors; its output is in the log. 77: there is no server.
    int run(const std::string& command) const {
        const int status =
            std::system(("'" STEREONAV_SOURCE_DIR "/tests/display/two_monitors.sh' '" + mFolder.string() +
                         "' " + command + " >'" + mFolder.string() + "/log' 2>&1")
                            .c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string textOf(const char* name) const {
        return std::filesystem::exists(mFolder / name) ? readTextFile(mFolder / name) : "";
    }

    std::filesystem::path mFolder;
};

TEST_F(TwoMonitors, HoldThemAll) {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const int status = run(std::string("env ") + kTwoMonitors + "=1 '" + self +
                           "' --gtest_filter='OnTwoMonitors.*:OnMonitors.*'");
    const std::string log = textOf("log");
    if (status == 77) GTEST_SKIP() << log;
    EXPECT_EQ(status, 0) << log;
    EXPECT_EQ(log.find("SKIPPED"), std::string::npos) << log;
}

TEST_F(TwoMonitors, TheProgramFillsTheOneThatIsMeant) {
    if (std::system("command -v xdotool >/dev/null") != 0) GTEST_SKIP() << "xdotool is not installed";
    const std::string folder = "'" + mFolder.string() + "'";
    const int status = run(
        "env HOME=" + folder + " XDG_CACHE_HOME=" + folder +
        "/cache '" STEREONAV_SOURCE_DIR "/tests/window/drive_monitors.sh' '" STEREONAV_PROGRAM "' " + folder);
    if (status == 77) GTEST_SKIP() << textOf("log");
    ASSERT_EQ(status, 0) << textOf("log") << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n");
    std::istringstream places(textOf("places.txt"));
    std::map<std::string, ScreenRect> at;
    std::string step;
    for (ScreenRect place; places >> step >> place.x >> place.y >> place.width >> place.height;)
        at[step] = place;
    EXPECT_EQ(at["option"], (ScreenRect{kSecondX, kSecondY, 3840, 1080}));
    EXPECT_EQ(at["key"].width, 320) << textOf("places.txt");
    EXPECT_EQ(at["key"].height, 240);
    EXPECT_EQ(at["again"], (ScreenRect{0, 0, 1025, 768})) << "the one that it was moved to";
}

}  // namespace
}  // namespace stereonav
