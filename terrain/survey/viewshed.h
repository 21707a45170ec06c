// Visibility of the ground from a place: for each sample, whether the line from the eye to it, or to a height
// above it, is clear. Results equal those of SightLines, sample by sample; for most samples they follow from
// bounds.
//
// Around the eye lie four fans of bins, narrow wedges in plan, that are swept outward column by column
// (row by row). Each bin has two slopes: one that the ground reaches on every ray in it (low) and one that it
// exceeds on none (high). A sample below low is hidden. A sample above high is seen, unless something within
// the last columns hides it, which are not in high yet: the line is tested there. Lines to samples between
// both are tested over the blocks of columns that reach up to them. Tests are made in packets, in floats with
// a known bound of rounding; undecided ones are repeated in doubles, and those within the rounding of doubles
// as single lines. Sweeping outward with horizons is the method of XDraw (Franklin, Ray and Mehta 1994),
// which interpolates one horizon instead of using two bounds and is not exact; the exact test of each sample
// is their R3.
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
    double reach = 0;         // metres in plan; 0: no limit
    double fall = 0;          // curvatureFall(), 1/metre, or 0
};

enum class Seen : std::uint8_t { Hidden = 0, NoGround = 128, Visible = 255 };  // also in files

struct Viewshed {
    Plane<std::uint8_t> seen;            // values of Seen; row 0 southernmost; hidden beyond reach
    long long visible = 0, samples = 0;  // samples: known ones within reach
    // Numbers of samples that were decided over the last columns, over all columns from the eye on, and in
    // doubles.
    long long walkedNear = 0, walkedAll = 0, walkedAlone = 0;
};

// Finds for each sample whether it is seen. Throws Error where the eye's place is outside the ground or in a
// hole; Cancelled.
Viewshed viewshedOf(const Heightfield& ground, const ViewshedSetting& setting, Progress& progress);

}  // namespace stereonav
