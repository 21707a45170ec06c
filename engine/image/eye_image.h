// What one eye sees: colour and view depth, and, only where the frame plan asks for view-dependent
// shading, what is needed to shade a pixel again for the other eye.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

constexpr float kMissDepth = std::numeric_limits<float>::infinity();

struct EyeImage {
    Plane<PackedColor> color;
    // Metres along the viewing axis (not along the ray); kMissDepth where the ray hit nothing;
    // 0 where nothing is known yet (a hole in a warped image).
    Plane<float> viewDepth;
    // Only with view-dependent shading, else empty: colour without the view-dependent part, and the
    // unit world normal (octahedral, 16 bits an axis, x in the low half).
    Plane<PackedColor> baseColor;
    Plane<std::uint32_t> normal;

    int width() const { return color.width(); }
    int height() const { return color.height(); }

    void resize(int width, int height, bool viewDependent = false) {
        color.resize(width, height);
        viewDepth.resize(width, height);
        baseColor.resize(viewDependent ? width : 0, viewDependent ? height : 0);
        normal.resize(viewDependent ? width : 0, viewDependent ? height : 0);
    }
};

}  // namespace stereonav
