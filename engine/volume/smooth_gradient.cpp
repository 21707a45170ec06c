// The gradient of the values under a tricubic B-spline (declared in surface_cells.h), in double precision:
// what corner normals of records must agree with.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/volume/surface_cells.h"

namespace stereonav {
namespace {

// Weights of four voxels along one axis, and of their derivative by voxels; f in [0, 1) from the second.
struct Weights {
    std::array<double, 4> value, slope;
    std::array<int, 4> at;  // voxels, clamped to the volume

    Weights(double x, int size) {
        // Two voxels beyond the faces all four are the outermost one; so NaN and huge numbers end there.
        x = x > -2.0 ? std::min(x, size + 1.0) : -2.0;
        const double floor = std::floor(x), f = x - floor, g = 1 - f;
        value = {g * g * g / 6, (4 - 3 * f * f * (2 - f)) / 6, (4 - 3 * g * g * (2 - g)) / 6, f * f * f / 6};
        slope = {-g * g / 2, f * (1.5 * f - 2), g * (2 - 1.5 * g), f * f / 2};
        for (int n = 0; n < 4; ++n) at[n] = std::clamp(static_cast<int>(floor) + n - 1, 0, size - 1);
    }
};

}  // namespace

glm::dvec3 smoothGradient(const GreyVolume& volume, const glm::dvec3& voxel) {
    const VolumeFrame& frame = volume.frame;
    const Weights x(voxel.x, frame.size.x), y(voxel.y, frame.size.y), z(voxel.z, frame.size.z);
    glm::dvec3 sum(0.0);
    for (int c = 0; c < 4; ++c)
        for (int b = 0; b < 4; ++b) {
            double value = 0, slope = 0;
            for (int a = 0; a < 4; ++a) {
                const double v = volume.at(x.at[a], y.at[b], z.at[c]);
                value += x.value[a] * v;
                slope += x.slope[a] * v;
            }
            sum += glm::dvec3(slope * y.value[b] * z.value[c], value * y.slope[b] * z.value[c],
                              value * y.value[b] * z.slope[c]);
        }
    return frame.axes * (sum / frame.spacing);
}

}  // namespace stereonav
