// Queries of a lumen at points between voxels, for centrelines: whether a point lies inside, how far the wall
// is.
#pragma once

#include "colon/segmentation/segmentation.h"
#include "engine/volume/distance_transform.h"

namespace stereonav {

// Points are in world metres. The lumen and the distances must outlive the probe; safe to use from many
// threads.
class LumenProbe {
public:
    LumenProbe(const LumenField& lumen, const DistanceVolume& distance, int segment);

    // Returns whether the nearest voxel is the segment's, and the trilinear value is on the lumen's side of
    // the wall.
    bool inside(const glm::dvec3& world) const;
    // Returns whether all of a straight line is inside, looked at every quarter of the smallest spacing.
    bool lineInside(const glm::dvec3& a, const glm::dvec3& b) const;
    // Returns the distance to the nearest outside voxel's centre, metres, linear between voxels; 0 beyond the
    // volume.
    double distance(const glm::dvec3& world) const;
    // Returns the radius of the largest sphere that fits, metres, on the safe side: the distance less half
    // the smallest spacing, because the wall lies about half way between the last voxel inside and the first
    // outside. That is right between plane walls along the grid; in a round tube of radius 8 mm on 0.8 mm
    // voxels it is 0.4 to 0.9 mm too small (some outside voxel's centre lies just behind the wall, and what
    // is linear between voxels cuts off the distance's crest in the middle).
    double radius(const glm::dvec3& world) const;
    double smallestSpacing() const { return mSmallest; }  // metres

private:
    struct Cell {  // a point's cell: lowest corner, share of the way to the highest
        glm::ivec3 corner;
        glm::dvec3 share;  // 0 to 1, along each axis
    };
    bool locate(const glm::dvec3& world, Cell& cell) const;

    const LumenField& mLumen;
    const DistanceVolume& mDistance;
    int mSegment;
    double mSmallest, mDiagonal;  // metres, of a voxel
};

}  // namespace stereonav
