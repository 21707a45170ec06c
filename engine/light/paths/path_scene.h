// A volume and its light in the form that the kernels of paths read. Owns the tables that the plain structs
// point to.
#pragma once

#include <vector>

#include "engine/light/paths/path_kernel_types.h"
#include "engine/light/paths/texel_light.h"
#include "engine/light/skies/light_setup.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Returns the kernels for the instruction set of availableTarget().
const PathKernels& pathKernels(SimdTarget target);

// Returns the volume in the kernels' form; `volume` must outlive the result.
PathVolume pathVolume(const GreyVolume& volume);

// Roulette: a path whose throughput (largest channel) has fallen below this goes on with the probability
// throughput / kDim.
constexpr float kDim = 0.25f;

// Returns the unit of lengths in the kernels, in metres.
double pathUnit(const VolumeFrame& frame);

// Writes a place in voxel space, within the volume's box, as a cell and coordinates in it, 0 to 1.
void splitPlace(const VolumeFrame& frame, const glm::dvec3& voxel, std::int32_t* cell, float* local);

// Light in the kernels' form; lights() is valid as long as this object lives.
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
