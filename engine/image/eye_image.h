// A picture of one eye: colour and view depth of each pixel, and further planes only where a ViewDependence
// asks for them.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// How a pixel's colour depends on the direction of view, and so which planes are kept for making the other
// eye's picture.
enum class ViewDependence {
    None,       // not at all
    Highlight,  // in part: a highlight, which takes the normal, is added to baseColor
    Normal,     // wholly: it follows from normal and depth, without baseColor
    Depths      // it mixes light of several depths, which parallax moves apart: depthSpread
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
    // Root mean square distance in metres, behind viewDepth, of the places that a pixel's light comes from,
    // weighted by their shares of the light; 0 without light. Only with ViewDependence::Depths.
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
