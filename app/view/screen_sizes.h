// How wide a screen is and from how far it is looked at: said on the command line, set by the person for this
// monitor, told by the monitor, or guessed. No window.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/view/window_config.h"

namespace stereonav {

// What a monitor tells of itself.
struct ScreenTold {
    std::string name;                    // of it
    int width_mm = 0, height_mm = 0;     // 0: unknown
    int pixelsWide = 0, pixelsHigh = 0;  // of its area, in the desktop's units
};

struct ScreenSize {
    enum class From { CommandLine, Person, Monitor, Guess };
    double width_mm = 0, distance_mm = 0;
    From widthFrom = From::Guess, distanceFrom = From::Guess;
};
// "the screen is 598 mm wide, as it tells, and 600 mm away"
std::string screenText(const ScreenSize& size);

class ScreenSizes {
public:
    // As the command line says; none: nothing.
    void say(std::optional<double> width_mm, std::optional<double> distance_mm);
    // As they were kept; of a monitor that is there twice the first counts.
    void setKept(std::vector<KeptScreen> kept) { mKept = std::move(kept); }
    const std::vector<KeptScreen>& kept() const { return mKept; }

    ScreenSize of(const ScreenTold& screen) const;
    // Its width is a guess, and nobody was asked yet.
    bool asks(const ScreenTold& screen) const;

    // Set by the person, brought within what is kept: it counts in the place of the command line's. None: as
    // if neither had said anything. What is no number changes nothing.
    void setWidth(const std::string& monitor, std::optional<double> mm);
    void setDistance(const std::string& monitor, std::optional<double> mm);
    void noteAsked(const std::string& monitor) { entry(monitor); }

private:
    const KeptScreen* find(const std::string& monitor) const;
    KeptScreen& entry(const std::string& monitor);

    std::optional<double> mWidth_mm, mDistance_mm;  // of the command line
    std::vector<KeptScreen> mKept;                  // newest first
};

}  // namespace stereonav
