// What parallax is on the real screen: millimetres, and degrees as the eyes see them. Parallax in pictures is
// a share of their width; whether eyes can follow it depends on how wide the picture stands before them.
// No OpenGL.
#pragma once

#include <string>

namespace stereonav {

// The distance between an adult's eyes: parallax behind the screen that is larger would have them turn
// outwards.
constexpr double kEyeDistance = 0.065;    // metres
constexpr double kDeskScreenWidth = 0.5;  // metres, for a screen that tells no size
constexpr double kViewingDistance = 0.6;  // metres

// The screen, and the viewer before it.
struct StereoScreen {
    double width = kDeskScreenWidth;     // metres, all of it, > 0
    double distance = kViewingDistance;  // metres, > 0
};

// Returns the screen's width as its maker states it, metres; kDeskScreenWidth where that is no size of a
// screen: nothing, less than a telephone's, or of another shape than its pixels (projectors state an aspect
// ratio).
double statedWidth(int width_mm, int height_mm, int pixelsWide, int pixelsHigh);

// Returns whether the stated size is one which somebody measured: no size of a screen is none, nor is what a
// desktop makes up where a monitor says nothing: as if it had 96 pixels an inch, both ways.
bool tellsWidth(int width_mm, int height_mm, int pixelsWide, int pixelsHigh);

// Parallax of one thing: negative before the screen, positive behind it.
struct ScreenParallax {
    double millimetres = 0;
    double degrees = 0;     // visual angle between its places for the two eyes
    bool diverges = false;  // behind the screen by more than the eyes' distance
};

// Returns parallax on the screen. parallax: share of the eye's picture; pictureWidth: of that picture, metres
// on the screen; distance: metres to the screen. All zero where one of them is no number or the width is not
// more than 0.
ScreenParallax onScreen(double parallax, double pictureWidth, double distance);

// Returns the metres on the screen of a picture so wide on a screen so wide, both in pixels. Pictures that
// the display widens again (half side by side) count with the pixels that they have before they are squeezed.
double pictureWidth(const StereoScreen& screen, double picturePixels, double screenPixels);

// Returns "on the screen -3.2 to +8.1 mm, -0.31 to +0.77 degrees"; "" where nothing is known.
std::string screenParallaxText(const ScreenParallax& nearest, const ScreenParallax& farthest);
// Returns a warning; "" unless the farthest thing diverges.
std::string divergenceText(const ScreenParallax& farthest);

}  // namespace stereonav
