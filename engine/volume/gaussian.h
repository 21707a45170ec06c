// Separable Gaussian smoothing of a small box of numbers, as it is needed around surfaces: whoever calls
// cuts a volume into boxes and runs them on all threads.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace stereonav {

// Returns half a symmetric kernel: weights of the middle and of the neighbours 1 .. n voxels away; with the
// other half the sum is 1. Cut off at 2.7 sigma. sigma: voxels; 0 gives the middle alone.
std::vector<float> gaussianWeights(double sigma);

// Smooths boxes of numbers; not for two threads at once.
class BoxSmoother {
public:
    explicit BoxSmoother(const glm::dvec3& sigma);  // voxels, along i, j, k; >= 0 and finite
    // Returns how many voxels away others count, along each axis.
    glm::ivec3 reach() const;
    // Smooths in place; i runs fastest. Beyond the faces the outermost voxels count on. Keeps its working
    // memory.
    void smooth(std::vector<float>& box, const glm::ivec3& size);

private:
    std::vector<float> mWeights[3];
    std::vector<float> mOther, mRow;  // numbers of the box and of a row of it
};

}  // namespace stereonav
