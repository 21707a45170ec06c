// Functions of the module stereonav_metrics (OpenCV) for metrics; they are defined in engine/metrics/opencv.
#pragma once

#include "engine/metrics/chart_picture.h"
#include "engine/metrics/difference_picture.h"
#include "engine/metrics/image_difference.h"

namespace stereonav {

struct MetricsFunctions {
    decltype(&stereonav::differenceOf) differenceOf;
    decltype(&stereonav::psnrOf) psnrOf;
    decltype(&stereonav::edgeMask) edgeMask;
    decltype(&stereonav::differenceTimes) differenceTimes;
    decltype(&stereonav::chartPicture) chartPicture;
};

}  // namespace stereonav
