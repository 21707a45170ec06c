// Between the program's packed pictures and OpenCV's 8-bit ones (BGR, sRGB).
#pragma once

#include <opencv2/core.hpp>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

cv::Mat bytesFromPlane(const Plane<PackedColor>& image);  // CV_8UC3
// image: CV_8UC3. A byte survives the way to a plane and back.
Plane<PackedColor> planeFromBytes(const cv::Mat& image);

}  // namespace stereonav
