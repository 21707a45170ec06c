// Parallax on the real screen: millimetres, and degrees for the eyes. Parallax in pictures is a share of
// their width; whether eyes can follow it depends on how wide the picture appears. Uses no OpenGL.
#pragma once

#include <string>

namespace stereonav {

// Distance between an adult's eyes: with larger parallax behind the screen the eyes would have to diverge.
constexpr double kEyeDistance = 0.065;    // metres
constexpr double kDeskScreenWidth = 0.5;  // metres, for a screen that reports no size
constexpr double kViewingDistance = 0.6;  // metres

// The screen, and the viewer in front of it.
struct StereoScreen {
    double width = kDeskScreenWidth;     // metres, all of it, > 0
    double distance = kViewingDistance;  // metres, > 0
};

// Returns the screen's width as reported, metres; kDeskScreenWidth where the report is implausible: zero,
// smaller than a telephone's, or with another aspect than its pixels (projectors report an aspect ratio).
double statedWidth(int width_mm, int height_mm, int pixelsWide, int pixelsHigh);

// Returns whether the reported size is a measured one: plausible, and not the one that a desktop assumes for
// monitors without a report, 96 pixels per inch in both directions.
bool tellsWidth(int width_mm, int height_mm, int pixelsWide, int pixelsHigh);

// Parallax of one object: negative before the screen, positive behind it.
struct ScreenParallax {
    double millimetres = 0;
    double degrees = 0;     // visual angle between its places for the two eyes
    bool diverges = false;  // behind the screen by more than the eyes' distance
};

// Returns parallax on the screen. parallax: share of the eye's picture; pictureWidth: of that picture, metres
// on the screen; distance: metres to the screen. All zero where an argument is no number or the width is not
// above 0.
ScreenParallax onScreen(double parallax, double pictureWidth, double distance);

// Returns the width of a picture on the screen in metres, from both widths in pixels. Pictures that the
// display widens again (half side by side) count with their unsqueezed pixels.
double pictureWidth(const StereoScreen& screen, double picturePixels, double screenPixels);

// Returns "on the screen -3.2 to +8.1 mm, -0.31 to +0.77 degrees"; "" where nothing is known.
std::string screenParallaxText(const ScreenParallax& nearest, const ScreenParallax& farthest);
// Returns a warning; "" unless the farthest thing diverges.
std::string divergenceText(const ScreenParallax& farthest);

}  // namespace stereonav
