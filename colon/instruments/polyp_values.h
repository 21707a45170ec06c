// CT values inside a polyp: only of voxels so deep that the scanner's blur does not mix in the air outside.
#pragma once

#include <optional>

#include "colon/instruments/polyp.h"
#include "colon/wall/wall_mesh.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Returns the standard deviation of the blur across the wall, metres: a flat edge under a normal blur has its
// steepest slope at 1 / (sqrt(2 pi) sigma) of its step. It is read from the median of many profiles along the
// wall's normals, each from air to tissue, and includes the interpolation between voxels, so that it is
// rather too large. Empty where too few places have air on one side and tissue on the other.
std::optional<double> blurAcrossWall(const GreyVolume& study, const WallMesh& wall);

// Distance from the wall, in standard deviations of the blur, at which a voxel is free of air: 0.02 % of the
// step remains behind a flat wall, and in the worst case, the middle of a ball of that radius, 0.7 % (about 7
// HU of 1,000).
constexpr double kBlurReaches = 3.5;
constexpr int kLeastVoxels = 10;  // fewer give no reliable mean

struct PolypValues {
    double mean = 0, sigma = 0;  // HU
    int voxels = 0;
};

// Returns values of the voxels between a polyp's wall and the lid on its outline that are nearer to its wall
// than to other wall, and at least kBlurReaches * blur away from any wall. blur: metres. Empty where these
// are fewer than kLeastVoxels.
std::optional<PolypValues> valuesInside(const GreyVolume& study, const WallMesh& wall,
                                        const MeasuredPolyp& polyp, double blur);

}  // namespace stereonav
