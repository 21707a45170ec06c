// A polyp on a lumen's wall: where it ends, and what it measures.
//
// It is the part around a place that bulges into the lumen both ways: its outline is where the smaller of the
// wall's principal curvatures changes its sign, at the neck of a head on a stalk and at the foot of one
// without. Folds do not bulge along their crest, and the wall between them not at all. The idea of principal
// curvatures as the end of a polyp is that of van Wijk et al., "Detection and segmentation of colonic polyps
// on implicit isosurfaces by second principal curvature flow", IEEE Trans. Med. Imaging 29 (2010), who move
// the wall until none is left; here it stays, and the outline is read from it.
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
    double curvatureRadius = 0.0013;  // metres, > 0, of the piece of wall that a curvature is fitted to
    double fromWall = 0.02;           // metres, > 0: how far from the wall the place may be
    double reach = 0.004;             // metres, > 0: how far from the place its tip may be
    double largest = 0.04;            // metres, > 0: how far from the tip its outline may be
    double flattest = 20;             // 1/metre, > 0: the tip is curved by at least this both ways
    // The least that is told from noise: cubic metres, and metres of three times the volume over the area.
    double leastVolume = 0, leastScore = 0;
};

// Returns settings for voxels of this size: a curvatureRadius of 1.6 voxels at least, as fewer vertices tell
// nothing; the least polyp has six voxels, and a score of half a voxel (docs/instruments.md).
PolypSetting polypSettingOf(const VolumeFrame& frame);

// The longest way between two places of it.
struct PolypWidth {
    double length = 0;              // metres
    glm::dvec3 from{0.0}, to{0.0};  // world, metres
};

// A polyp's parts and measures.
struct MeasuredPolyp {
    std::uint32_t tip = 0;                // vertex, the most curved
    std::vector<std::uint32_t> vertices;  // vertices of its head, ascending
    std::vector<glm::dvec3> outline;      // world, metres: the vertices next to its head
    glm::dvec3 middle{0.0};               // world, metres, of its vertices
    glm::dvec3 outward{0.0};              // unit: the mean normal, into the lumen
    PolypWidth widest;                    // in space
    PolypWidth widestInSlice;             // in a plane of voxels
    int sliceAxis = 2;                    // axis across the plane: 0 sagittal, 1 coronal, 2 axial
    double slice = 0;                     // metres, where on that axis
    double area = 0, volume = 0;          // square and cubic metres; the volume above a lid on its outline
    // Returns three times the volume over the area, metres: the radius of a ball, about one and a half times
    // the height of a flat one.
    double score() const { return area > 0 ? 3 * volume / area : 0; }
};

// Returns the vertex nearest to a place: world, metres. Throws Error where the mesh has none.
std::uint32_t nearestVertex(const WallMesh& mesh, const glm::dvec3& place);

// Returns the polyp at or next to a place; nothing where the wall does not bulge there, or it is larger or
// less than the setting allows; `why` then says so in a clause.
std::optional<MeasuredPolyp> polypAt(const WallMesh& mesh, const WallNeighbours& neighbours,
                                     const glm::dvec3& place, const PolypSetting& setting, std::string& why);

// Returns the same from the vertex that is nearest.
std::optional<MeasuredPolyp> polypAt(const WallMesh& mesh, const WallNeighbours& neighbours,
                                     std::uint32_t vertex, const PolypSetting& setting, std::string& why);

}  // namespace stereonav
