// Differences of pictures, through OpenCV.
#include "engine/image/opencv/byte_image.h"
#include "engine/metrics/difference_picture.h"

namespace stereonav {

Plane<PackedColor> differenceTimes(const Plane<PackedColor>& truth, const Plane<PackedColor>& image,
                                   int factor) {
    cv::Mat difference;
    cv::absdiff(bytesFromPlane(truth), bytesFromPlane(image), difference);
    difference.convertTo(difference, CV_8UC3, factor);
    return planeFromBytes(difference);
}

}  // namespace stereonav
