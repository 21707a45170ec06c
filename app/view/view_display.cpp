#include "app/view/view_display.h"

#include <glm/common.hpp>
#include <utility>

#include "app/view/kept_file.h"
#include "engine/base/error.h"
#include "engine/display/eye_passes.h"

namespace stereonav {
namespace {

constexpr const char* kNoQuadBuffer =
    "quad: the graphics driver grants no buffer for each eye; shown side by side (sbsl)";

}  // namespace

// A benchmark measures both eyes.
ViewDisplay::ViewDisplay(Window& window, const ViewOptions& options)
    : mWindow(window), mMode{ShownMode().mode, false}, mModeChosen(options.mode || options.bench) {
    if (mModeChosen) mGiven = ShownMode{options.mode.value_or(ShownMode().mode), true};
    if (mGiven) mMode = *mGiven;
    if (wantsQuadBuffer(options) && !window.quadBuffered()) {
        mMode.mode = OutputMode::SideBySide;
        mGiven = mMode;
        mNotice = kNoQuadBuffer;
    }
    follow(options);
}

void ViewDisplay::setMode(const ShownMode& mode) {
    mModeChosen = mModeChosen || mode != mMode;
    mMode = mode;
}

void ViewDisplay::restoreMode(const ShownMode& kept) {
    if (!mModeChosen && (kept.mode != OutputMode::QuadBuffer || mWindow.quadBuffered())) mMode = kept;
}

std::optional<ShownMode> ViewDisplay::modeToKeep() const {
    return mGiven == mMode ? std::nullopt : std::optional(mMode);
}

void ViewDisplay::follow(const ViewOptions& options) {
    if (options.fullScreen != mFullScreen) fill(options.fullScreen);
    mFullScreen = options.fullScreen;
    mSizes.say(options.screenWidth_mm, options.viewingDistance_mm);
}

void ViewDisplay::fill(const std::string& monitor) {
    if (monitor.empty()) return mWindow.leaveFullScreen();
    const std::vector<Monitor> all = monitors();
    const auto named = monitorNamed(all, monitor);
    mWindow.enterFullScreen(named ? *named : monitorUnder(all, mWindow.place()).value_or(0));
}

std::optional<Monitor> ViewDisplay::monitor() const {
    const std::vector<Monitor>& all = recentMonitors();
    const auto under = monitorUnder(all, mWindow.place());
    return under ? std::optional(all[*under]) : std::nullopt;
}

SizeOption ViewDisplay::windowSize() const {
    const glm::ivec2 size = glm::max(mWindow.framebufferSize(), glm::ivec2(1));
    return {size.x, size.y};
}

void ViewDisplay::toggleFullScreen() {
    try {
        mWindow.toggleFullScreen();
    } catch (const Error& error) {
        mNotice = error.what();
    }
}

bool ViewDisplay::alternates(const ComposeSetting& setting) {
    return infoOf(setting.mode).layout == OutputLayout::FrameSequential;
}

std::optional<double> ViewDisplay::wait() const {
    return mSequence ? std::optional(mSequence->wait(Window::now())) : std::nullopt;
}

void ViewDisplay::draw(const ComposeSetting& setting,
                       const std::function<void(const ComposeSetting&)>& drawOne) {
    const bool alternating = alternates(setting);
    if (!alternating) mSequence.reset();
    if (alternating && (!mSequence || mPlace != mWindow.place())) {
        const std::optional<Monitor> on = monitor();
        mPlace = mWindow.place();
        // Reported again only on another monitor.
        const double rate = on ? on->refreshRate : 0;
        if (!mSequence || mSequence->toldRate() != rate) mSequence.emplace(rate);
    }
    for (const EyePass& pass : eyePasses(setting, mSequence ? mSequence->eye() : 0, mWindow.quadBuffered())) {
        drawInto(pass.buffer);
        drawOne(pass.setting);
    }
    if (mWindow.quadBuffered()) drawInto(BackBuffer::Both);
    if (!mSequence) return mWindow.swapBuffers();
    mSequence->swapped(mWindow.swapTimed());
    if (!mNotice.empty()) return;  // the last notice was not taken yet
    if (auto problem = mSequence->takeProblem()) mNotice = *std::move(problem);
}

std::string ViewDisplay::takeNotice() {
    return std::exchange(mNotice, {});
}

ScreenAnswer ViewDisplay::screen() const {
    const ScreenTold told = this->told();
    const ScreenSize size = mSizes.of(told);
    return {screenText(size), size.width_mm, mSizes.asks(told)};
}

double ViewDisplay::refreshPeriod() const {
    constexpr double kUsual = 60, kLeast = 20, kMost = 500;  // Hz
    const std::optional<Monitor> on = monitor();
    const double rate = on ? on->refreshRate : 0;
    return 1 / (rate >= kLeast && rate <= kMost ? rate : kUsual);
}

ScreenTold ViewDisplay::told() const {
    constexpr std::size_t kLongestName = 200;
    const std::optional<Monitor> on = monitor();
    if (!on) return {};
    return {keptText(on->name, kLongestName), on->width_mm, on->height_mm, on->area.width, on->area.height};
}

double ViewDisplay::pictureWidthOf(const ViewFrame& frame, const ScreenTold& on) const {
    const int window = mWindow.place().width, pixels = mWindow.framebufferSize().x;
    // Width on the monitor, in the window's units.
    const double width = pixels > 0 ? (frame.left.width() - 2 * frame.request.guard.x) / frame.request.scale *
                                          (static_cast<double>(window) / pixels)
                                    : 0;
    const ScreenSize size = mSizes.of(on);
    return pictureWidth({size.width_mm / 1000, size.distance_mm / 1000}, width,
                        on.pixelsWide > 0 ? on.pixelsWide : window);
}

ScreenWords ViewDisplay::wordsOf(const ViewFrame& frame) const {
    if (!frame.request.twoEyes) return {};
    const ScreenTold on = told();
    const double width = pictureWidthOf(frame, on), distance = mSizes.of(on).distance_mm / 1000;
    const auto far = onScreen(frame.farParallax, width, distance);
    return {screenParallaxText(onScreen(frame.nearParallax, width, distance), far), divergenceText(far)};
}

}  // namespace stereonav
