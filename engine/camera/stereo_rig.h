// Two eyes from one head: the only file that knows left from right. Both eyes share one image plane
// (no toe-in); their windows coincide at the zero-parallax distance. So a point keeps its scanline,
// and its pixel moves by a shift that depends on its view depth alone (Wan et al. 2004, eq. 3; there
// the head is the left eye, here it lies midway, which changes the constants and nothing else).
#pragma once

#include "engine/camera/eye_view.h"
#include "engine/camera/pose.h"

namespace stereonav {

// The size and angle of the picture, common to both eyes.
struct Lens {
    int width = 0, height = 0;  // pixels of one eye
    double verticalFov = 0.8;   // radians, in (0, pi)
    double pixelAspect = 1.0;   // width / height of a pixel
    double nearDepth = 0.1;     // metres
    double fall = 0;            // 1 / metres, as EarthBend's: 0 where the Earth is level
    bool operator==(const Lens&) const = default;
};

// The separation of the eyes, and the distance of the screen's plane.
struct StereoSetting {
    double separation = 0.065;   // metres between the eyes, >= 0
    double zeroParallax = 1.95;  // metres along the view axis to the plane seen without parallax, > 0
    bool operator==(const StereoSetting&) const = default;
};

// Both eyes of one head, and the shift between their pictures.
struct StereoViews {
    EyeView left, right;

    // A point at view depth z seen at continuous column x by the left eye is seen by the right eye
    // at x + shiftAtInfinity - parallaxScale / z, on the same row.
    double shiftAtInfinity = 0;  // pixels, >= 0
    double parallaxScale = 0;    // pixels * metres, >= 0

    // Returns the column, in pixels, where the right eye sees that point. viewDepth: metres.
    double rightColumn(double leftColumn, double viewDepth) const {
        return leftColumn + (shiftAtInfinity - parallaxScale / viewDepth);
    }
};

// Returns both eyes, each half the separation from the head. Throws Error on sizes, angles or distances that
// are not finite or out of range.
StereoViews makeStereoViews(const Pose& head, const Lens& lens, const StereoSetting& setting);

// Returns the single eye of the head itself, with a symmetric window. Throws Error as makeStereoViews() does.
EyeView makeEyeView(const Pose& head, const Lens& lens);

}  // namespace stereonav
