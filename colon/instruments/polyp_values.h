// CT values inside a polyp: only voxels that the air beyond its wall does not reach through the scanner's
// blur.
#pragma once

#include <optional>

#include "colon/instruments/polyp.h"
#include "colon/wall/wall_mesh.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Returns the standard deviation of the blur across the wall, metres: a flat edge under a normal blur has its
// steepest slope at 1 / (sqrt(2 pi) sigma) of its step. Read from the median of many profiles along the
// wall's normals, each from air to tissue. It has the interpolation between voxels in it, so it is rather too
// large. Returns nothing where too few places have air on one side and tissue on the other.
std::optional<double> blurAcrossWall(const GreyVolume& study, const WallMesh& wall);

// Standard deviations of the blur away from the wall at which a voxel is free of air: 0.02 % of the step is
// left behind a flat wall, and 0.7 % in the middle of a ball of that radius, which is the worst (some 7 HU of
// 1,000).
constexpr double kBlurReaches = 3.5;
constexpr int kLeastVoxels = 10;  // fewer tell nothing

struct PolypValues {
    double mean = 0, sigma = 0;  // HU
    int voxels = 0;
};

// Returns values of the voxels between a polyp's wall and the lid on its outline that are nearer to its wall
// than to other wall, and at least kBlurReaches * blur away from any. blur: metres. Returns nothing where
// these are less than kLeastVoxels.
std::optional<PolypValues> valuesInside(const GreyVolume& study, const WallMesh& wall,
                                        const MeasuredPolyp& polyp, double blur);

}  // namespace stereonav
