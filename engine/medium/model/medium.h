// A participating medium in the world: a grid of values under a transfer function, or thin layers over height
// fields, both with perturbation by noise. at() is the plain definition of what kernels and shaders sample.
#pragma once

#include <memory>
#include <vector>

#include "engine/medium/model/height_layer.h"
#include "engine/medium/model/medium_table.h"
#include "engine/medium/model/perturbation.h"
#include "engine/volume/illumination_volume.h"
#include "engine/volume/volume.h"

namespace stereonav {

// A box along the world's axes.
struct WorldBox {
    glm::dvec3 low{0.0}, high{0.0};  // world, metres
    bool empty() const { return !(low.x < high.x && low.y < high.y && low.z < high.z); }
    glm::dvec3 center() const { return 0.5 * (low + high); }
};

class Medium {
public:
    Medium() = default;  // empty space
    // A medium in a grid of values, which are trilinear between voxel centres. It is empty beyond the centres
    // of the outermost voxels. Throws Error for values out of range.
    Medium(std::shared_ptr<const GreyVolume> field, const MediumTransfer& transfer,
           Perturbation perturbation = {});
    // A medium of layers only; where several overlap, their properties are added by extinction. The
    // perturbation displaces the place at which they are looked up. Throws Error.
    explicit Medium(std::vector<HeightLayer> layers, Perturbation perturbation = {});

    // Returns the medium's properties at a place. footprint: metres that a sample stands for, for the mip
    // level of layers; 0: the finest. time: seconds, for the noise.
    OpticalProperties at(const glm::dvec3& world, double time = 0, double footprint = 0) const;
    // Returns the gradient of the grid's value at the displaced place, in value units per metre along world
    // axes, by central differences over one voxel to each side; at the faces, outermost voxels are repeated.
    // 0 outside. For layers: the upward normal of the nearest one.
    glm::dvec3 gradientAt(const glm::dvec3& world, double time = 0) const;

    const GreyVolume* field() const { return mField.get(); }  // null: layers alone
    const MediumTable& table() const { return mTable; }
    const std::vector<HeightLayer>& layers() const { return mLayers; }
    const Perturbation& perturbation() const { return mPerturbation; }
    const NoiseVolume* noise() const { return mNoise.get(); }  // null: not perturbed

    // Returns a box around everything that is not empty, displacements included.
    const WorldBox& bounds() const { return mBounds; }
    double largestExtinction() const { return mLargestExtinction; }  // 1 / metres, anywhere

private:
    void usePerturbation(Perturbation perturbation);
    glm::dvec3 displaced(const glm::dvec3& world, double time) const;
    OpticalProperties unperturbed(const glm::dvec3& place, double footprint) const;

    std::shared_ptr<const GreyVolume> mField;
    MediumTable mTable;
    std::vector<HeightLayer> mLayers;
    Perturbation mPerturbation;
    std::shared_ptr<const NoiseVolume> mNoise;
    WorldBox mBounds;
    double mLargestExtinction = 0;  // 1 / metres
};

}  // namespace stereonav
