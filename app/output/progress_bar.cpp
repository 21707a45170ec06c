#include "app/output/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "engine/base/loop_watch.h"
#include "engine/text/printable.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

constexpr double kRedraw_ms = 80.0;           // often enough to look alive, and without noticeable cost
constexpr double kLineInterval_ms = 10000.0;  // for output that is not a terminal

// Returns the interval of lines that the environment sets for programs that read them, or the default.
double lineInterval_ms() {
    const char* const asked = std::getenv("STEREONAV_PROGRESS_SECONDS");
    const double seconds = asked ? std::atof(asked) : 0;
    return seconds > 0 ? std::max(1000 * seconds, kRedraw_ms) : kLineInterval_ms;
}

}  // namespace

std::string progressLine(double fraction, const std::string& what, int barWidth) {
    fraction = std::clamp(fraction, 0.0, 1.0);
    const int full = static_cast<int>(fraction * barWidth);
    std::string bar(static_cast<std::size_t>(full), '=');
    if (full < barWidth) bar += '>';
    bar.resize(static_cast<std::size_t>(barWidth), ' ');
    return fmt::format("[{}] {:3d} % {}", bar, static_cast<int>(fraction * 100.0), what);
}

ProgressBar::ProgressBar(bool shown)
    : mShown(shown),
      mTerminal(isatty(STDERR_FILENO) != 0),
      mProgress([this](double fraction, const std::string& what) { show(fraction, what); },
                [this](const std::string& note) { tell(note); }) {
    mLineInterval_ms = lineInterval_ms();
    mNext_ms = mTerminal ? 0.0 : mLineInterval_ms;
    if (mShown) watchLoops([this](double share) { showAgain(share); });
}

ProgressBar::~ProgressBar() {
    if (mShown) watchLoops({});
    clear();
}

void ProgressBar::show(double fraction, const std::string& what) {
    if (!mShown) return;
    const std::lock_guard lock(mMutex);
    const double now = mSinceStart.elapsed_ms();
    if (what != mWhat || fraction != mFraction) mReported_ms = mLoopStart_ms = now;
    mFraction = fraction;
    if (what != mWhat) mWhat = what;
    if (now >= mNext_ms) draw(now);
}

// Prints each note once, however often a file is read.
void ProgressBar::tell(const std::string& note) {
    if (!mShown) return;
    const std::lock_guard lock(mMutex);
    if (!mTold.insert(note).second) return;
    if (mTerminal && mDrawn) std::fputs("\r\033[K", stderr);
    mDrawn = false;
    printNote(note);
}

// Redraws the bar; called by the first thread only.
void ProgressBar::showAgain(double share) {
    const double now = mSinceStart.elapsed_ms();
    if (share < mLoopShare) mLoopStart_ms = now;
    mLoopShare = share;
    if (now < mNext_ms) return;
    const std::unique_lock lock(mMutex, std::try_to_lock);
    if (lock) draw(now);
}

// Draws the bar; the mutex has to be held.
void ProgressBar::draw(double now_ms) {
    constexpr double kLong_ms = 2000;  // duration of a report or loop from which on it is shown
    mNext_ms = now_ms + (mTerminal ? kRedraw_ms : mLineInterval_ms);
    const double since_ms = now_ms - mReported_ms;
    std::string what = mWhat;
    if (since_ms >= kLong_ms) what += fmt::format(", {:.0f} s", since_ms / 1000);
    if (since_ms >= kLong_ms && now_ms - mLoopStart_ms >= kLong_ms)
        what += fmt::format(", {:.0f} % of this step", std::floor(100 * mLoopShare));
    if (mTerminal)
        std::fputs(("\r\033[K" + printable(progressLine(mFraction, what, 30), kLongestLine)).c_str(), stderr);
    else
        printLine(stderr, fmt::format("{:3d} % {}", static_cast<int>(mFraction * 100.0), what));
    std::fflush(stderr);
    mDrawn = true;
}

void ProgressBar::clear() {
    const std::lock_guard lock(mMutex);
    if (mTerminal && mDrawn) std::fputs("\r\033[K", stderr);
    mDrawn = false;
}

}  // namespace stereonav
