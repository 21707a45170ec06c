// Rasters that are placed by ground control points instead of a transform, with GDAL's polynomials.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>

#include "terrain/raster/georeference.h"

namespace stereonav {

// Places the raster by its control points, which it must have. Points that lie on an affine grid to a
// twentieth of a sample, and three to five points, give a transform; six or more give a polynomial of second
// order in both directions (Georeference::points), if it does not fold over itself. Both are least-squares
// fits: errors of single points even out, and a polynomial of low order stays moderate beyond the outermost
// points, while a thin plate would follow each point and its error. They are also the default of GDAL's
// warper. Throws Error for fewer than three points, for points on one line or without a reference system.
void placeByControlPoints(GDALDataset& dataset, const std::filesystem::path& file, Georeference& place);

// Maps a raster's pixels to its reference coordinates and back, by its transform or its control points. For
// one thread.
class PixelPlacement {
    struct Destroy {
        void operator()(void* transformer) const;
    };

public:
    using Transformer = std::unique_ptr<void, Destroy>;

    // raster must outlive the object. Throws Error that names no file where the points give no polynomial.
    explicit PixelPlacement(const Georeference& raster);
    glm::dvec2 fromPixel(const glm::dvec2& pixel) const;
    // Where control points place the raster, this is a separate fit and not the exact inverse of fromPixel().
    glm::dvec2 toPixel(const glm::dvec2& reference) const;

private:
    glm::dvec2 through(const glm::dvec2& place, bool back) const;

    const Georeference& mRaster;
    Transformer mTransformer;  // nullptr: the transform is used
};

}  // namespace stereonav
