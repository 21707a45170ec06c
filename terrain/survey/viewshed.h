// What of the ground is seen from a place: for each sample whether the line from the eye to it, or to a
// height above it, is clear. The answer is that of SightLines, sample by sample; most samples get it by
// bounds.
//
// Around the eye lie four fans of bins, narrow wedges over the plan, that are swept outward column by column
// (row by row). Of each bin two slopes are known: one that every ray in it has met (low) and one that none
// has exceeded (high). A sample below low is hidden. One above high is seen, if nothing within the last
// columns, which high lags behind, hides it; those are walked. What lies between both is walked over those
// blocks of columns that reach up to the line. Walks are made in packets, in floats with stated rounding;
// what that leaves open is walked in doubles, and what is within their rounding as one line by itself.
// Sweeping outward with horizons is that of XDraw (Franklin, Ray and Mehta 1994), which interpolates one
// horizon in the place of two bounds and is not exact; the exact walk of each sample is their R3.
#pragma once

#include <cstdint>

#include "engine/base/progress.h"
#include "engine/image/plane.h"
#include "terrain/survey/sight_line.h"

namespace stereonav {

struct ViewshedSetting {
    glm::dvec2 eye{0.0};      // grid; on the ground
    double eyeHeight = 2;     // metres above the ground there, 0 or more
    double targetHeight = 0;  // metres above the samples, 0 or more
    double reach = 0;         // metres over the plan; 0: all
    double fall = 0;          // curvatureFall(), 1/metre, or 0
};

enum class Seen : std::uint8_t { Hidden = 0, NoGround = 128, Visible = 255 };  // also in files

struct Viewshed {
    Plane<std::uint8_t> seen;            // Seen; row 0 southernmost; beyond reach: hidden
    long long visible = 0, samples = 0;  // samples: known and within reach
    // Numbers of samples that were told by the last columns, by columns from the eye on, and again in
    // doubles.
    long long walkedNear = 0, walkedAll = 0, walkedAlone = 0;
};

// Tells for each sample whether it is seen. Throws Error where the eye's place is not on the ground, or in a
// hole of it; Cancelled.
Viewshed viewshedOf(const Heightfield& ground, const ViewshedSetting& setting, Progress& progress);

}  // namespace stereonav
