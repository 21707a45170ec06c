// Rasters in their reference systems, through GDAL's OSR: their units, their true size, a grid in metres.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>

#include "terrain/raster/georeference.h"

class OGRSpatialReference;

namespace stereonav {

// Metres in one unit of the reference system: 1 where it has none; 0 for degrees.
double metresPerUnit(const Georeference& raster);

// True length over length in the reference system's own metres at a place, along columns and rows: 1 where a
// map unit is a metre on the ground. (1, 1) where that can not be said.
glm::dvec2 groundScale(const Georeference& raster, const glm::dvec2& pixel);

// Returns whether its reference system is tied to the Earth, or another body: geographic or projected.
bool onEarth(const Georeference& raster);

// Metres: the mean radius (2a + b) / 3 of the ellipsoid that it is tied to; 0 where it is tied to none.
double bodyRadiusOf(const Georeference& raster);

// Returns what x grows by once around the body, in the system's units: 360 degrees, or of maps that are a
// strip without ends (web Mercator, plate carree) their length; 0 of others.
double fullTurnOf(const OGRSpatialReference& system);

// Returns whether a projected raster lies over the north or the south pole.
bool holdsPole(const Georeference& raster);

// The raster's samples on a grid in metres, north up: in a transverse Mercator projection whose origin is the
// raster's middle; with ownSystem, or without a reference system, in the raster's own units, turned level.
// Steps are those of the source at its middle. The grid is the rectangle inside the raster where that keeps
// nine tenths of the area around it, else the rectangle around it. Throws Error that names `file`.
Georeference metricGrid(const Georeference& raster, bool ownSystem, const std::filesystem::path& file);

// mapPixels() for a run of the target's rows at a time, whose places are the same: for targets larger than
// memory. To one thread.
class PixelMapRows {
public:
    // Throws Error as mapPixels() does.
    PixelMapRows(const Georeference& target, const Georeference& source, const std::filesystem::path& file);
    // A map of rows from first, a multiple of PixelMap::kStep, on: row 0 of the map is first.
    PixelMap map(int first, int rows) const;
    // Pixels between its nodes.
    int step() const { return 1 << mShift; }
    // The source's place of one place of the target, (0, 0) is the centre of its first pixel: exact.
    glm::dvec2 at(double column, double row) const { return mExact(column, row); }

private:
    std::function<glm::dvec2(double column, double row)> mExact;  // place of a pixel's centre
    int mWidth, mShift;
};

}  // namespace stereonav
