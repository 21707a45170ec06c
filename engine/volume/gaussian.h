// Separable Gaussian smoothing of a small box of numbers, as it is needed around surfaces: whoever calls
// cuts a volume into boxes and runs them on all threads.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace stereonav {

// Half a symmetric kernel: weights of the middle and of the neighbours 1 .. n voxels away; with the other
// half the sum is 1. Cut off at 2.7 sigma. sigma: voxels; 0 gives the middle alone.
std::vector<float> gaussianWeights(double sigma);

class BoxSmoother {
public:
    explicit BoxSmoother(const glm::dvec3& sigma);  // voxels, along i, j, k; >= 0 and finite
    // How far from a voxel others count, along each axis.
    glm::ivec3 reach() const;
    // In place; i runs fastest. Beyond the faces the outermost voxels count on. Keeps its working memory.
    void smooth(std::vector<float>& box, const glm::ivec3& size);

private:
    std::vector<float> mWeights[3];
    std::vector<float> mOther, mRow;
};

}  // namespace stereonav
