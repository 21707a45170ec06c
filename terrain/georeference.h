// Where a raster lies on the Earth, and the mapping from one raster's pixels to another's. Used to
// bring elevation models to metres and to lay images over them.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace stereonav {

// Pixel coordinates: (0, 0) is the outer corner of the first pixel, its centre is (0.5, 0.5).
// Reference coordinates: transform[0] + c * transform[1] + r * transform[2], and [3] to [5] for y.
struct Georeference {
    std::string wkt;                                     // reference system; "" when none is known
    std::array<double, 6> transform{0, 1, 0, 0, 0, -1};  // GDAL's order
    int width = 0, height = 0;                           // pixels

    glm::dvec2 fromPixel(const glm::dvec2& pixel) const;
    glm::dvec2 toPixel(const glm::dvec2& reference) const;
    // Whether rows run east-west and columns north-south, to a hundredth of a pixel.
    bool axisAligned() const;
};

// Metres in one unit of the reference system: 1 where it has none; 0 for degrees.
double metresPerUnit(const Georeference& raster);

// True length over length in the reference system's own metres at the middle, along columns and rows:
// 1 where a map unit is a metre on the ground. (1, 1) where that can not be said.
glm::dvec2 groundScale(const Georeference& raster);

// The raster's samples on a grid in metres, north up, in a transverse Mercator projection whose origin
// is the raster's middle (or, without a reference system, in the raster's own units, turned level).
// Steps are those of the source at its middle. The grid is the rectangle inside the raster where
// that keeps nine tenths of the area around it, else the rectangle around it. Throws Error named by
// `file`.
Georeference metricGrid(const Georeference& raster, const std::filesystem::path& file);

// Pixel coordinates in `source` of the pixel centres of `target`, exact at every kStep-th pixel and
// bilinear between. Exact nodes are computed on construction; at() is safe from several threads.
class PixelMap {
public:
    static constexpr int kStep = 16;
    // Throws Error named by `file` when there is no way between the two reference systems.
    PixelMap(const Georeference& target, const Georeference& source, const std::filesystem::path& file);

    // Infinite or NaN where there is no such place in the source.
    glm::dvec2 at(int column, int row) const;

private:
    int mNodesX = 0;
    std::vector<glm::dvec2> mNodes;
};

// Whether the two rasters share ground. Throws Error as PixelMap does.
bool overlap(const Georeference& a, const Georeference& b, const std::filesystem::path& file);

}  // namespace stereonav
