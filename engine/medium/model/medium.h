// A participating medium in the world: a grid of values under a transfer function, thin layers over height
// fields, both perturbed. at() is the plain statement of what kernels and shaders sample.
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
    // A grid: the value is trilinear between voxel centres, nothing is outside the grid's outermost ones.
    // Throws Error for what is out of range.
    Medium(std::shared_ptr<const GreyVolume> field, const MediumTransfer& transfer,
           Perturbation perturbation = {});
    // Layers alone; where several overlap their properties are added by extinction. The perturbation moves
    // the place in them. Throws Error.
    explicit Medium(std::vector<HeightLayer> layers, Perturbation perturbation = {});

    // footprint: metres a sample stands for, for mip levels; 0: the finest. time: seconds, of the noise.
    OpticalProperties at(const glm::dvec3& world, double time = 0, double footprint = 0) const;
    // Returns the gradient of the grid's value at the displaced place, by central differences of one voxel to
    // both sides: value units a metre, world axes; 0 outside; at the faces the outermost voxels count on.
    // With layers: the upward normal of the nearest one.
    glm::dvec3 gradientAt(const glm::dvec3& world, double time = 0) const;

    const GreyVolume* field() const { return mField.get(); }  // null: layers alone
    const MediumTable& table() const { return mTable; }
    const std::vector<HeightLayer>& layers() const { return mLayers; }
    const Perturbation& perturbation() const { return mPerturbation; }
    const NoiseVolume* noise() const { return mNoise.get(); }  // null: not perturbed

    // The box that holds everything which is not empty, displacements counted.
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
