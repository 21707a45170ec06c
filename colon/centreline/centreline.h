// The centreline of a lumen, from rectum to caecum: the path that a guided flight follows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "colon/segmentation/segmentation.h"
#include "engine/volume/distance_transform.h"

namespace stereonav {

struct CentrelinePoint {
    glm::dvec3 position{0.0};  // world, metres
    double radius = 0;         // metres: of the largest sphere there that fits into the lumen
    int segment = 1;           // number of its segment of the lumen; between segments the path crosses tissue
};

struct Centreline {
    std::vector<CentrelinePoint> points;  // evenly spaced, rectum to caecum
    double length() const;                // metres, along the points
};

struct CentrelineSetting {
    double spacing = 0.001;  // metres between points; more where they would be more than 50,000
    bool reversed = false;   // the ends were taken for each other: the whole line the other way round
    // Number of voxels above which a piece is searched in blocks of two voxels along all axes, also along
    // axes that are sampled more coarsely than others. The search takes time in proportion to the number of
    // blocks.
    std::size_t mostUneven = 50'000'000;
};

// Finds the centreline. distance: distanceToOutside(lumen.lumen). Every point of a segment lies inside it (by
// the mask alone when lumen.field is empty: find the line before the field is moved away); a segment of one
// voxel has one point. The rectum is taken to be the lower end of the first segment, or the one further back
// where both are about level; each further segment starts at its end that is nearer. The ends are drawn back
// from the wall. 0.6 s and 125 MB for the 7.9 million voxels of a real colon (0.8 mm), most of the time on
// one thread. Throws Error, Cancelled.
Centreline findCentreline(const LumenField& lumen, const DistanceVolume& distance,
                          const CentrelineSetting& setting, Progress& progress);

// Returns whether writeCentreline() knows the extension.
bool isCentrelineFileName(const std::filesystem::path& file);
// Writes by extension. .txt: "x y z radius segment" a line, LPS millimetres. .vtp, .vtk: poly data of one
// polyline a segment with the point array MaximumInscribedSphereRadius, LPS millimetres, as the vascular
// modelling toolkit and 3D Slicer write it, and the cell array Segment. Written atomically. Throws Error.
void writeCentreline(const std::filesystem::path& file, const Centreline& line);

}  // namespace stereonav
