// What one eye sees: colour and view depth, and, only where the frame plan asks for view-dependent
// shading, what is needed to shade a pixel again for the other eye.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// How a pixel's colour depends on the direction of view, and so what is kept to shade it again.
enum class ViewDependence {
    None,       // not at all
    Highlight,  // a part is added to baseColor; the normal is needed for it
    Normal,     // all of it follows from normal and depth: no baseColor
    Depths      // it is gathered from several depths, that shift apart: how far is kept
};

constexpr float kMissDepth = std::numeric_limits<float>::infinity();  // view depth where nothing is hit

// The planes of a picture of one eye, all of one size or empty.
struct EyeImage {
    Plane<PackedColor> color;
    // Metres along the viewing axis (not along the ray); kMissDepth where the ray hit nothing;
    // 0 where nothing is known yet (a hole in a warped image).
    Plane<float> viewDepth;
    // Planes of view-dependent shading, else empty. Highlight: baseColor is the colour without the
    // view-dependent part, normal the unit world normal (octahedral, see packed_normal.h). Normal: only the
    // normal, as three channels like a colour's (10 bits each, x lowest, 0..1023 for -1..1), so that it is
    // resampled like one.
    Plane<PackedColor> baseColor;
    Plane<std::uint32_t> normal;
    // Metres behind viewDepth that a pixel's light comes from, with Depths alone: the root of the mean square
    // by shares of light; 0 where it comes from nowhere.
    Plane<float> depthSpread;

    int width() const { return color.width(); }
    int height() const { return color.height(); }

    // Gives the image the planes that `dependence` asks for, all of width x height pixels.
    void resize(int width, int height, ViewDependence dependence = ViewDependence::None) {
        const bool base = dependence == ViewDependence::Highlight;
        const bool any = base || dependence == ViewDependence::Normal;
        const bool depths = dependence == ViewDependence::Depths;
        color.resize(width, height);
        viewDepth.resize(width, height);
        baseColor.resize(base ? width : 0, base ? height : 0);
        normal.resize(any ? width : 0, any ? height : 0);
        depthSpread.resize(depths ? width : 0, depths ? height : 0);
    }
};

}  // namespace stereonav
