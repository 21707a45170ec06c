// The centreline of a lumen, from rectum to caecum: the path that a guided flight follows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "colon/segmentation.h"
#include "engine/volume/distance_transform.h"

namespace stereonav {

struct CentrelinePoint {
    glm::dvec3 position{0.0};  // world, metres
    double radius = 0;         // metres: of the largest sphere there that fits into the lumen
    int segment = 1;           // of the lumen; between segments the path crosses tissue
};

struct Centreline {
    std::vector<CentrelinePoint> points;  // evenly spaced, rectum to caecum
    double length() const;                // metres, along the points
};

struct CentrelineSetting {
    double spacing = 0.001;  // metres between points
    bool reversed = false;   // the ends were taken for each other: start at the other one
};

// distance: distanceToOutside(lumen.lumen). Every point of a segment lies inside it. Throws Error, Cancelled.
Centreline findCentreline(const LumenField& lumen, const DistanceVolume& distance,
                          const CentrelineSetting& setting, Progress& progress);

// By extension. .txt: "x y z radius segment" a line, LPS millimetres. .vtp, .vtk: poly data of one polyline a
// segment with the point array MaximumInscribedSphereRadius, LPS millimetres, as the vascular modelling
// toolkit and 3D Slicer write it. Written atomically. Throws Error.
void writeCentreline(const std::filesystem::path& file, const Centreline& line);
Centreline readCentreline(const std::filesystem::path& file);  // .txt and .vtp/.vtk in the forms written here

}  // namespace stereonav
