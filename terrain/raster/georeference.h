// Where a raster lies on the Earth, and the mapping from one raster's pixels to another's. Used to
// bring elevation models to metres and to lay images over them.
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
    // Six or more where a polynomial through these places the pixels (terrain/read/gdal/control_points.h):
    // then the transform, and what follows from it here, is only near.
    std::vector<ControlPoint> points;
    std::string placedBy;  // how control points place it, in words; "" where they do not

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
    static constexpr int kStep = 16;  // pixels between nodes at most
    // Takes what mapPixels() of raster_file.h gives: rows of nodesX nodes each, pixel coordinates of the
    // source, 2^shift pixels apart.
    PixelMap(int nodesX, std::vector<glm::dvec2> nodes, int shift);

    // Returns the pixel coordinates in the source of a target pixel's centre; infinite or NaN where there is
    // no such place.
    glm::dvec2 at(int column, int row) const;

private:
    int mNodesX = 0, mShift = 0;
    std::vector<glm::dvec2> mNodes;
};

}  // namespace stereonav
