#include "engine/image/opencv/byte_image.h"

namespace stereonav {

cv::Mat bytesFromPlane(const Plane<PackedColor>& image) {
    cv::Mat bytes(image.height(), image.width(), CV_8UC3);
    const auto& table = srgbByteFromPacked();
    for (int y = 0; y < image.height(); ++y) {
        auto* to = bytes.ptr<cv::Vec3b>(y);
        for (int x = 0; x < image.width(); ++x) {
            const PackedColor c = image.at(x, y);
            to[x] = {table[c >> 20 & 1023], table[c >> 10 & 1023], table[c & 1023]};
        }
    }
    return bytes;
}

Plane<PackedColor> planeFromBytes(const cv::Mat& image) {
    Plane<PackedColor> plane(image.cols, image.rows);
    const auto& table = packedFromSrgbByte();
    for (int y = 0; y < image.rows; ++y) {
        const auto* from = image.ptr<cv::Vec3b>(y);
        for (int x = 0; x < image.cols; ++x)
            plane.at(x, y) = static_cast<PackedColor>(table[from[x][2]] | table[from[x][1]] << 10 |
                                                      table[from[x][0]] << 20);
    }
    return plane;
}

}  // namespace stereonav
