// The width of a screen and its viewing distance: given on the command line, set by the user for this
// monitor, reported by the monitor, or guessed. Needs no window.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/view/window_config.h"

namespace stereonav {

// The report of a monitor.
struct ScreenTold {
    std::string name;
    int width_mm = 0, height_mm = 0;     // 0: unknown
    int pixelsWide = 0, pixelsHigh = 0;  // pixels of its area, in the desktop's units
};

struct ScreenSize {
    enum class From { CommandLine, Person, Monitor, Guess };
    double width_mm = 0, distance_mm = 0;
    From widthFrom = From::Guess, distanceFrom = From::Guess;
};
// Returns "the screen is 598 mm wide, as it tells, and 600 mm away".
std::string screenText(const ScreenSize& size);

class ScreenSizes {
public:
    // Sets the values of the command line; empty: not given.
    void say(std::optional<double> width_mm, std::optional<double> distance_mm);
    // Sets the kept values; the first entry of a monitor counts.
    void setKept(std::vector<KeptScreen> kept) { mKept = std::move(kept); }
    const std::vector<KeptScreen>& kept() const { return mKept; }

    ScreenSize of(const ScreenTold& screen) const;
    // Returns whether the width is a guess and the user has not been asked.
    bool asks(const ScreenTold& screen) const;

    // Take the user's values, limited to the permitted range, in the place of the command line's. Empty: as
    // if neither were given. Values that are no numbers change nothing.
    void setWidth(const std::string& monitor, std::optional<double> mm);
    void setDistance(const std::string& monitor, std::optional<double> mm);
    void noteAsked(const std::string& monitor) { entry(monitor); }

private:
    const KeptScreen* find(const std::string& monitor) const;
    KeptScreen& entry(const std::string& monitor);

    std::optional<double> mWidth_mm, mDistance_mm;  // from the command line
    std::vector<KeptScreen> mKept;                  // newest first
};

}  // namespace stereonav
