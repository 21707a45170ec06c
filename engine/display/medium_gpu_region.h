// The part of an eye's picture in which a slice of the medium's box can be seen: only it is drawn for a slab.
#pragma once

#include "engine/medium/sweep/sweep_geometry.h"

namespace stereonav {

// Pixels of an eye's buffer.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;
    bool empty() const { return width <= 0 || height <= 0; }
};

// Returns a rectangle that contains every pixel whose ray meets the plane t within the box (world); all
// pixels where a part of the slice lies behind the eye. t: metres along the sweep's axis.
PixelRect coveredBySlice(const WorldBox& box, const SweepGeometry& geometry, double t, const RayFan& fan);

PixelRect united(const PixelRect& a, const PixelRect& b);  // smallest that contains both
// Grows by a margin in pixels on each side, within the fan's buffer; empty ones stay so.
PixelRect grown(const PixelRect& rect, int margin, const RayFan& fan);

}  // namespace stereonav
