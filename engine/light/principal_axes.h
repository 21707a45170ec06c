// Eigenvectors of a symmetric matrix, through OpenCV: the module stereonav_axes (engine/light/opencv).
#pragma once

#include <vector>

namespace stereonav {

// matrix: size x size, symmetric, row by row. Unit vectors, one a row, of the largest eigenvalue first. From
// any thread.
std::vector<double> principalAxes(const std::vector<double>& matrix, int size);

struct AxesFunctions {
    decltype(&stereonav::principalAxes) principalAxes;
};

}  // namespace stereonav
