#include "app/view/screen_sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/display/stereo_screen.h"

namespace stereonav {
namespace {

constexpr double kMm = 1000;  // millimetres in a metre

const char* wordsFor(ScreenSize::From from) {
    switch (from) {
        case ScreenSize::From::CommandLine:
            return "as the command line says";
        case ScreenSize::From::Person:
            return "as it was set";
        case ScreenSize::From::Monitor:
            return "as it reports";
        case ScreenSize::From::Guess:
            break;
    }
    return "a guess";
}

}  // namespace

std::string screenText(const ScreenSize& size) {
    return fmt::format("The screen is {:.4g} mm wide, {}, and {:.4g} mm away.", size.width_mm,
                       wordsFor(size.widthFrom), size.distance_mm);
}

void ScreenSizes::say(std::optional<double> width_mm, std::optional<double> distance_mm) {
    mWidth_mm = width_mm;
    mDistance_mm = distance_mm;
}

const KeptScreen* ScreenSizes::find(const std::string& monitor) const {
    const auto found = std::find_if(mKept.begin(), mKept.end(),
                                    [&](const KeptScreen& screen) { return screen.monitor == monitor; });
    return found == mKept.end() ? nullptr : &*found;
}

// Returns the entry of a monitor and puts it first: those used last are kept longest.
KeptScreen& ScreenSizes::entry(const std::string& monitor) {
    KeptScreen screen;
    if (const KeptScreen* const found = find(monitor)) screen = *found;
    screen.monitor = monitor;
    std::erase_if(mKept, [&](const KeptScreen& other) { return other.monitor == monitor; });
    mKept.insert(mKept.begin(), screen);
    if (mKept.size() > kMostScreens) mKept.resize(kMostScreens);
    return mKept.front();
}

ScreenSize ScreenSizes::of(const ScreenTold& screen) const {
    const KeptScreen* const kept = find(screen.name);
    const double stated =
        statedWidth(screen.width_mm, screen.height_mm, screen.pixelsWide, screen.pixelsHigh);
    const bool told = tellsWidth(screen.width_mm, screen.height_mm, screen.pixelsWide, screen.pixelsHigh);
    ScreenSize size{kMm * stated, kMm * kViewingDistance,
                    told ? ScreenSize::From::Monitor : ScreenSize::From::Guess, ScreenSize::From::Guess};
    if (kept && kept->width_mm) size.width_mm = *kept->width_mm, size.widthFrom = ScreenSize::From::Person;
    if (kept && kept->viewingDistance_mm)
        size.distance_mm = *kept->viewingDistance_mm, size.distanceFrom = ScreenSize::From::Person;
    if (mWidth_mm) size.width_mm = *mWidth_mm, size.widthFrom = ScreenSize::From::CommandLine;
    if (mDistance_mm) size.distance_mm = *mDistance_mm, size.distanceFrom = ScreenSize::From::CommandLine;
    return size;
}

bool ScreenSizes::asks(const ScreenTold& screen) const {
    return of(screen).widthFrom == ScreenSize::From::Guess && !find(screen.name);
}

void ScreenSizes::setWidth(const std::string& monitor, std::optional<double> mm) {
    if (mm && !std::isfinite(*mm)) return;
    mWidth_mm.reset();
    if (mm) mm = std::clamp(*mm, kScreenWidthRange.low, kScreenWidthRange.high);
    if (mm || find(monitor)) entry(monitor).width_mm = mm;
}

void ScreenSizes::setDistance(const std::string& monitor, std::optional<double> mm) {
    if (mm && !std::isfinite(*mm)) return;
    mDistance_mm.reset();
    if (mm) mm = std::clamp(*mm, kViewingDistanceRange.low, kViewingDistanceRange.high);
    if (mm || find(monitor)) entry(monitor).viewingDistance_mm = mm;
}

}  // namespace stereonav
