// Rasters in their reference systems, through GDAL's OSR: their units, their true size, a grid in metres.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>

#include "terrain/raster/georeference.h"

class OGRSpatialReference;

namespace stereonav {

// Returns metres per unit of the reference system: 1 without one; 0 for degrees.
double metresPerUnit(const Georeference& raster);

// Returns the true length divided by the length in the reference system's own metres at a place, along
// columns and rows: 1 where a map unit is a metre on the ground. (1, 1) where it is unknown.
glm::dvec2 groundScale(const Georeference& raster, const glm::dvec2& pixel);

// Returns whether its reference system is tied to the Earth, or another body: geographic or projected.
bool onEarth(const Georeference& raster);

// Returns the mean radius (2a + b) / 3 of the reference system's ellipsoid in metres; 0 without one.
double bodyRadiusOf(const Georeference& raster);

// Returns the period of x around the body, in the system's units: 360 degrees, or the length of maps that
// form an endless strip (web Mercator, plate carree); 0 for others.
double fullTurnOf(const OGRSpatialReference& system);

// Returns whether a projected raster lies over the north or the south pole.
bool holdsPole(const Georeference& raster);

// Returns a grid in metres, north up, for the raster's samples: in a transverse Mercator projection around
// the raster's middle; with ownSystem, or without a reference system, in the raster's own units, without
// rotation. Its steps are those of the source at its middle. It is the largest rectangle inside the raster
// where that keeps nine tenths of the area of the rectangle around it, else the one around it. Throws Error
// that names `file`.
Georeference metricGrid(const Georeference& raster, bool ownSystem, const std::filesystem::path& file);

// mapPixels() in runs of the target's rows, with identical results, for targets larger than memory. For one
// thread.
class PixelMapRows {
public:
    // Throws Error as mapPixels() does.
    PixelMapRows(const Georeference& target, const Georeference& source, const std::filesystem::path& file);
    // Returns a map of rows from `first`, a multiple of PixelMap::kStep, on; row 0 of the map is `first`.
    PixelMap map(int first, int rows) const;
    // Returns the number of pixels between the map's nodes.
    int step() const { return 1 << mShift; }
    // Returns the exact place in the source of a place in the target; (0, 0) is the centre of its first
    // pixel.
    glm::dvec2 at(double column, double row) const { return mExact(column, row); }

private:
    std::function<glm::dvec2(double column, double row)> mExact;  // place of a pixel's centre
    int mWidth, mShift;
};

}  // namespace stereonav
