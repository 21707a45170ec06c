// The place of a raster on the Earth, and the mapping of one raster's pixels to another's, for bringing
// elevation models to metres and laying images over them.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace stereonav {

// A pixel whose reference coordinates are known.
struct ControlPoint {
    glm::dvec2 pixel{0.0}, reference{0.0};
};

// Pixel coordinates: (0, 0) is the outer corner of the first pixel, its centre is (0.5, 0.5).
// Reference coordinates: transform[0] + c * transform[1] + r * transform[2], and [3] to [5] for y.
struct Georeference {
    std::string wkt;                                     // reference system; "" when none is known
    std::array<double, 6> transform{0, 1, 0, 0, 0, -1};  // GDAL's order
    int width = 0, height = 0;                           // pixels
    // Six or more points where a polynomial through them places the pixels
    // (terrain/read/gdal/control_points.h); the transform, and functions that use it, are then only
    // approximate.
    std::vector<ControlPoint> points;
    std::string placedBy;  // how control points place the raster, in words; "" without control points

    // Map pixel coordinates to reference coordinates, and back.
    glm::dvec2 fromPixel(const glm::dvec2& pixel) const;
    glm::dvec2 toPixel(const glm::dvec2& reference) const;
    // Returns whether rows run east-west and columns north-south, to a hundredth of a pixel.
    bool axisAligned() const;
};

// Pixel coordinates in `source` of the pixel centres of `target`, exact at nodes 16, 4 or 1 pixels apart and
// bilinear between: to a hundredth of a pixel. at() is safe from several threads.
class PixelMap {
public:
    static constexpr int kStep = 16;  // largest distance of nodes, pixels
    // Takes the result of mapPixels() in raster_file.h: rows of nodesX nodes each, pixel coordinates in the
    // source, 2^shift pixels apart.
    PixelMap(int nodesX, std::vector<glm::dvec2> nodes, int shift);

    // Returns the pixel coordinates in the source of the centre of a target pixel; infinite or NaN where
    // there is no such place.
    glm::dvec2 at(int column, int row) const;

private:
    int mNodesX = 0, mShift = 0;
    std::vector<glm::dvec2> mNodes;
};

}  // namespace stereonav
