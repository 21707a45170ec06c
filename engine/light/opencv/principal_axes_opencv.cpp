// The module stereonav_axes.
#include <opencv2/core.hpp>

#include "engine/base/module.h"
#include "engine/light/principal_axes.h"

namespace stereonav {

std::vector<double> principalAxes(const std::vector<double>& matrix, int size) {
    const cv::Mat symmetric(size, size, CV_64F, const_cast<double*>(matrix.data()));
    cv::Mat values, axes;
    cv::eigen(symmetric, values, axes);
    return {axes.begin<double>(), axes.end<double>()};
}

static constexpr AxesFunctions kFunctions = {principalAxes};
const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
