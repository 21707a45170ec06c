#include "colon/segmentation/mask_smoothing.h"

#include <algorithm>
#include <cmath>

#include "colon/segmentation/wall_crossings.h"
#include "colon/segmentation/wall_field.h"
#include "colon/segmentation/wall_relaxation.h"

namespace stereonav {
namespace {

constexpr double kUsualVoxels = 2;

double coarsest(const VolumeFrame& frame) {
    return std::max({frame.spacing.x, frame.spacing.y, frame.spacing.z});
}

// Bends spread as heat does: the way goes with the root of the rounds.
WallRelaxation relaxationOver(double voxels) {
    WallRelaxation setting;
    const double square = voxels * voxels / (kUsualVoxels * kUsualVoxels);
    setting.rounds = std::max(1, static_cast<int>(std::lround(setting.rounds * square)));
    setting.share = std::min(1.0, setting.share / square);
    return setting;
}

}  // namespace

double smoothedLength(const MaskSmoothing& smoothing, const VolumeFrame& frame) {
    const double voxel = coarsest(frame);
    return std::min(smoothing.value_or(kUsualVoxels * voxel), kMostSmoothed * voxel);
}

void smoothWall(const VoxelRuns& inside, double length, GreyVolume& field, Progress& progress) {
    Progress finding(progress, 0, 0.1), relaxing(progress, 0.1, 0.6), filling(progress, 0.6, 1);
    finding.report(0, "finding the mask's wall");
    WallCrossings wall = findCrossings(inside);
    const WallRelaxation setting = relaxationOver(length / coarsest(field.frame));
    const std::vector<glm::vec3> normals =
        relaxWall(wall, linksOf(wall), field.frame.spacing, setting, relaxing);
    fillWallField(inside, wall, normals, field, filling);
}

}  // namespace stereonav
