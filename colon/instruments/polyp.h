// A polyp on a lumen's wall: its outline and its measurements.
//
// It is the part around a place that is convex towards the lumen in both directions: its outline is where the
// smaller of the wall's principal curvatures changes its sign, at the neck of a stalked polyp and at the foot
// of one without a stalk. Folds are not convex along their crest, and the wall between them is not at all.
// The idea to end a polyp by principal curvatures is that of van Wijk et al., "Detection and segmentation of
// colonic polyps on implicit isosurfaces by second principal curvature flow", IEEE Trans. Med. Imaging 29
// (2010), who move the wall until no polyp is left; here the wall stays, and the outline is read from it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "colon/wall/wall_curvature.h"
#include "colon/wall/wall_mesh.h"
#include "engine/volume/volume.h"

namespace stereonav {

struct PolypSetting {
    // Metres, > 0: radius of the piece of wall to which a curvature is fitted.
    double curvatureRadius = 0.0013;
    double fromWall = 0.02;  // metres, > 0: largest distance of the place from the wall
    double reach = 0.004;    // metres, > 0: largest distance of the tip from the place
    double largest = 0.04;   // metres, > 0: largest distance of the outline from the tip
    double flattest = 20;    // 1/metre, > 0: smallest curvature of the tip in both directions
    // Smallest polyp that is told from noise: cubic metres; metres of three times the volume over the area.
    double leastVolume = 0, leastScore = 0;
};

// Returns settings for voxels of this size: a curvatureRadius of at least 1.6 voxels, since fewer vertices
// give no reliable curvature; the smallest polyp has six voxels, and a score of half a voxel
// (docs/instruments.md).
PolypSetting polypSettingOf(const VolumeFrame& frame);

// The longest distance between two places of a polyp.
struct PolypWidth {
    double length = 0;              // metres
    glm::dvec3 from{0.0}, to{0.0};  // world, metres
};

// A polyp's parts and measures.
struct MeasuredPolyp {
    std::uint32_t tip = 0;                // vertex with the largest curvature
    std::vector<std::uint32_t> vertices;  // vertices of its head, ascending
    std::vector<glm::dvec3> outline;      // world, metres: the vertices beside its head
    glm::dvec3 middle{0.0};               // world, metres: mean of its vertices
    glm::dvec3 outward{0.0};              // unit: the mean normal, into the lumen
    PolypWidth widest;                    // in space
    PolypWidth widestInSlice;             // within a plane of voxels
    int sliceAxis = 2;                    // axis across the plane: 0 sagittal, 1 coronal, 2 axial
    double slice = 0;                     // metres: position of that plane along the axis
    double area = 0, volume = 0;          // square and cubic metres; the volume above a lid on its outline
    // Returns three times the volume over the area, metres: for a ball its radius, for a flat polyp about one
    // and a half times its height.
    double score() const { return area > 0 ? 3 * volume / area : 0; }
};

// Returns the vertex nearest to a place: world, metres. Throws Error where the mesh has none.
std::uint32_t nearestVertex(const WallMesh& mesh, const glm::dvec3& place);

// Returns the polyp at or near a place; empty where the wall is not convex there, or where the polyp is
// larger or smaller than the setting allows; `why` then says so in a clause.
std::optional<MeasuredPolyp> polypAt(const WallMesh& mesh, const WallNeighbours& neighbours,
                                     const glm::dvec3& place, const PolypSetting& setting, std::string& why);

// Does the same from the nearest vertex.
std::optional<MeasuredPolyp> polypAt(const WallMesh& mesh, const WallNeighbours& neighbours,
                                     std::uint32_t vertex, const PolypSetting& setting, std::string& why);

}  // namespace stereonav
