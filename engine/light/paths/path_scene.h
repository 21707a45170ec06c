// A volume and its light as the kernels of paths read them. Owns the tables that the plain structs point to.
#pragma once

#include <vector>

#include "engine/light/paths/path_kernel_types.h"
#include "engine/light/paths/texel_light.h"
#include "engine/light/skies/light_setup.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Returns the kernels of the set that availableTarget() gives.
const PathKernels& pathKernels(SimdTarget target);

// The volume as kernels read it; `volume` must outlive the result.
PathVolume pathVolume(const GreyVolume& volume);

// Roulette: paths whose throughput (its largest channel) has fallen below this go on with a probability that
// is their share of it.
constexpr float kDim = 0.25f;

// The unit of lengths in the kernels: metres.
double pathUnit(const VolumeFrame& frame);

// Writes a place in voxel space within the volume's box, as a cell and what remains, 0 to 1.
void splitPlace(const VolumeFrame& frame, const glm::dvec3& voxel, std::int32_t* cell, float* local);

// Light as kernels read it: lights() is valid as long as this lives.
class PathLightTables {
public:
    PathLightTables(const VolumeFrame& frame, const LightSetup& setup, const TexelSampling& sampling);
    PathLightTables(const PathLightTables&) = delete;
    PathLightTables& operator=(const PathLightTables&) = delete;

    const PathLights& lights() const { return mLights; }

private:
    void tabulate(const LightProbe& probe);
    void addPoints(const VolumeFrame& frame, const std::vector<PointLight>& points);

    PathLights mLights;
    std::vector<float> mPixels, mRows, mColumns, mEdges;  // the arrays of PathProbe
    std::vector<PathPoint> mPoints;
};

}  // namespace stereonav
